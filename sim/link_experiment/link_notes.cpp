#include "sim/link_experiment/link_notes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "sim/columns/closing_lines.hpp"
#include "sim/counting/statistics.hpp"
#include "sim/link/validity.hpp"
#include "sim/link_experiment/answer_text.hpp"
#include "sim/result/alarms.hpp"
#include "sim/result/point_loss.hpp"
#include "sim/result/ranking.hpp"
#include "sim/result/unit_spread.hpp"
#include "sim/scenario/flags.hpp"
#include "sim/text/rounded_text.hpp"

namespace sim {
namespace {

constexpr const char* alarm_sign = "!!";

/// How many errors more than theory the samples should make: of the points where bits failed, that
/// where it is most.
std::string theory_note(const LinkResult& result) {
  double most = 0;
  for (const LinkPoint& p : result.points) {
    const double more = p.operating.ber_sampled / p.operating.ber_theory - 1;
    const bool has_failed = bit_error_ratio(p.tally, LinkResult::ci_level).value > 0;
    if (has_failed && std::isfinite(more) && std::abs(more) > std::abs(most)) most = more;
  }
  if (std::abs(most) < 0.001) return "";
  return fmt::format(
      "in theory all bits are alike; sampled they are not, and make up to {:.1f} % {} errors\n",
      100 * std::abs(most), most > 0 ? "more" : "fewer");
}

std::string target_note(const LinkResult& result) {
  if (std::ranges::none_of(result.points, may_stop_by_target)) return "";
  return "frame loss ratios are median-unbiased and their intervals allow for a stop by "
         "target_flr; "
         "lost over frames is `flr` in the file\n";
}

template <class Flag>
std::string mark(std::span<const Flag> table, std::uint64_t mask, const char* sign) {
  return (mask == 0 ? "" : "  ") + raised_mark(table, mask, sign);
}

}  // namespace

std::string closing_text(const LinkPoint& point) {
  return stop_reason_name(point.stop) +
         mark(validity_limits(), point.validity_flags, validity_sign) +
         mark(alarms(), point.alarms, alarm_sign);
}

std::string mark_notes(const LinkResult& result) {
  std::uint64_t validity_flags = 0, alarming = 0;
  for (const LinkPoint& p : result.points) {
    validity_flags |= p.validity_flags;
    alarming |= p.alarms;
  }
  return raised_notes(validity_limits(), validity_flags, validity_sign) +
         raised_notes(alarms(), alarming, alarm_sign) + target_note(result) + theory_note(result);
}

namespace {

/// All points that are counted, or all that are weighted.
Tally sum_of(const LinkResult& result, bool weighted) {
  Tally all;
  for (const LinkPoint& p : result.points)
    if (p.tally.is_weighted() == weighted) all += p.tally;
  return all;
}

std::string weighted_note(const Tally& all) {
  if (all.n_frames == 0) return "";
  return fmt::format(
      "importance sampling: {} of {} frames lost as drawn; ratios are weighted to what comes by "
      "nature\n",
      all.n_frames_lost, all.n_frames);
}

std::string reasons_note(const Tally& all) {
  if (all.n_frames_lost == 0) return "";
  const std::pair<const char*, std::uint64_t> reasons[]{
      {"nothing heard", all.n_frames_unheard},
      {"no line ended", all.n_frames_unended},
      {"wrong checksum", all.n_rejected_checksum},
      {"unprintable characters", all.n_rejected_unprintable},
      {"no hexadecimal checksum", all.n_rejected_not_hex},
      {"too short", all.n_rejected_short},
      {"too long", all.n_rejected_overlong}};
  std::vector<std::string> known;
  for (const auto& [reason, count] : reasons)
    if (count > 0) known.push_back(fmt::format("{} {}", reason, count));
  return fmt::format("{} frames lost: {}{}\n", all.n_frames_lost, fmt::join(known, ", "),
                     known.size() > 1 ? " (a frame may have several reasons)" : "");
}

}  // namespace

std::string loss_reasons(const LinkResult& result) {
  return reasons_note(sum_of(result, false)) + weighted_note(sum_of(result, true));
}

std::string link_notes(const LinkResult& result, const Ranking& ranking) {
  std::string notes = mark_notes(result) + loss_reasons(result);
  if (!has_units(result.axes))
    notes += ranking_lines(result, ranking) + answer_sentence(result, ranking);
  return notes;
}

std::string missing_lines(const LinkResult& result) {
  const auto begun = std::ranges::count_if(result.points, &LinkPoint::reached);
  const auto finished = std::ranges::count_if(result.points, [](const LinkPoint& p) {
    return p.reached() && p.stop != StopReason::interrupted;
  });
  return unfinished_note(result.points.size(), static_cast<std::size_t>(finished),
                         static_cast<std::size_t>(begun)) +
         shards_note(result.shards);
}

}  // namespace sim
