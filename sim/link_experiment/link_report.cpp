#include "sim/link_experiment/link_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "sim/counting/statistics.hpp"
#include "sim/link_experiment/link_charts.hpp"
#include "sim/link_experiment/link_columns.hpp"
#include "sim/link_experiment/link_json.hpp"
#include "sim/link_experiment/link_notes.hpp"
#include "sim/link_experiment/range_doubt.hpp"
#include "sim/result/unfinished.hpp"
#include "sim/threads/profile.hpp"

namespace sim {
namespace {

using Swept = SweptPoints<LinkPoint>;

LinkResult result_of(const Swept& swept) {
  LinkResult result = link_result(swept.scenario, swept.command, swept.points);
  result.shards = swept.shards;
  return result;
}

/// Of frames that are drawn to fail the counts say nothing, their weights do.
std::string progress_of(const LinkPoint& point) {
  const double ber = bit_error_ratio(point.tally, LinkResult::ci_level).value;
  return fmt::format(", {} lost{}, BER {}", point.tally.n_frames_lost,
                     point.tally.is_weighted() ? " as drawn" : "",
                     std::isnan(ber) ? "not yet known" : fmt::format("{:.2g}", ber));
}

/// Of a link that carries, 1 % of frames at most are lost.
bool carries(const LinkPoint& point) {
  const Tally& tally = point.tally;
  if (tally.is_weighted()) return frame_loss_ratio(tally, LinkResult::ci_level).value <= 0.01;
  return tally.n_frames > 0 && 100 * tally.n_frames_lost <= tally.n_frames;
}

std::string carried_so_far(const std::vector<LinkPoint>& points, std::size_t done) {
  const auto end = points.begin() + static_cast<std::ptrdiff_t>(done);
  return fmt::format("{} of {} lose at most 1 % of frames",
                     std::count_if(points.begin(), end, carries), done);
}

std::string profile_of(const std::vector<LinkPoint>& points) {
  Profile profile;
  std::uint64_t samples = 0;
  for (const LinkPoint& point : points) {
    profile += point.profile;
    samples += point.n_samples;
  }
  return profile_lines(profile, samples);
}

/// How far the links reach, with its doubts where all shards are counted.
Ranking ranking_of(const Swept& swept, const LinkResult& result) {
  Ranking ranking = rank(result);
  const bool is_whole = std::ranges::all_of(swept.shards, [](auto s) { return s == Shard{}; });
  if (is_whole) add_doubts(ranking, swept.scenario, swept.workers);
  return ranking;
}

std::string notes_of(const Swept& swept) {
  const LinkResult result = result_of(swept);
  return link_notes(result, ranking_of(swept, result));
}

std::string json_of(const Swept& swept, const Dataset& data) {
  const LinkResult result = result_of(swept);
  return to_json(result, data, ranking_of(swept, result));
}

}  // namespace

constinit const PointReport<LinkPoint> link_report{
    .columns = link_columns,
    .complete = complete_link,
    .progress = progress_of,
    .so_far = carried_so_far,
    .profile = profile_of,
    .json = json_of,
    .charts = [](const Swept& swept) { return result_charts(result_of(swept)); },
    .notes = notes_of};

}  // namespace sim
