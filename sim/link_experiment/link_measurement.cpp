#include "sim/link_experiment/link_measurement.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <utility>

#include "sim/engine/counted_runs.hpp"
#include "sim/engine/run_counting.hpp"
#include "sim/link_experiment/batch_sizes.hpp"
#include "sim/loading/point_scenario.hpp"
#include "sim/result/alarms.hpp"
#include "sim/result/unfinished.hpp"

namespace sim {
namespace {

void put_counts(LinkPoint& point, const LinkTally& tally) {
  point.tally = tally.sum.tally;
  point.simulated_s = tally.sum.simulated_s;
  point.n_samples = tally.sum.n_samples;
  point.profile = tally.sum.profile;
  point.elapsed_s = tally.elapsed_s;
}

void describe_link(LinkPoint& point, const Link& link) {
  point.operating = link.operating;
  point.validity_flags = link.validity_flags;
  point.alarms = own_alarms(point);
}

std::vector<RunSpan<LinkTally>> run_link_groups(const LinkSetup& setup, std::uint32_t first, int n,
                                                const std::atomic<bool>* stop) {
  const std::vector<GroupResult> groups = run_groups(setup.link, first, n, stop, setup.profiled);
  std::vector<RunSpan<LinkTally>> spans;
  spans.reserve(groups.size());
  auto left = static_cast<std::uint32_t>(n);
  for (const GroupResult& group : groups) {
    spans.push_back({std::min(group_size, left), {group}});
    left -= spans.back().n;
  }
  return spans;
}

bool is_sound(const WeightedSum& sum) {
  const double parts[] = {sum.sum, sum.squares, sum.largest, sum.group_squares};
  return std::ranges::all_of(parts, [](double part) { return part >= 0 && std::isfinite(part); });
}

bool is_sound(const Weighted& weighted) {
  const double groups = weighted.n_groups;
  return (groups == 0 || (groups >= 1 && std::isfinite(groups))) && is_sound(weighted.bit_errors) &&
         is_sound(weighted.frames_lost) && std::isfinite(weighted.dark_likelihood);
}

bool fits_link(const LinkSetup&, const LinkTally& counted, std::uint32_t frames) {
  const Tally& t = counted.sum.tally;
  return t.n_frames == frames && t.n_frames_ok + t.n_frames_lost == t.n_frames &&
         t.n_frames_undetected <= t.n_frames && t.n_frames_bit_errors <= t.n_frames &&
         t.n_bit_errors <= t.n_bits && t.n_byte_errors <= t.n_bytes && is_sound(t.weighted);
}

/// The alarms of rows across the grid.
void describe_rows(const LoadedScenario& scenario, std::vector<LinkPoint>& points) {
  LinkResult result;
  result.axes = scenario.sweep;
  result.points = std::move(points);
  add_row_alarms(result);
  points = std::move(result.points);
}

}  // namespace

constinit const Measurement<LinkSetup, LinkTally, LinkPoint> link_measurement{
    .unreached =
        [](const Scenario& s, const SourceLocations&, const std::vector<double>& coordinates) {
          return LinkPoint{
              .coordinates = coordinates, .stop = StopReason::interrupted, .rule = rule_of(s.stop)};
        },
    .prepare =
        [](const Scenario& s, const SourceLocations&, const Workers& w) {
          return LinkSetup{make_link(s), w.profiled};
        },
    .most_at_once = [](const LinkSetup& setup, std::uint32_t,
                       int) { return batch_sizes(setup.link).most; },
    .ratio = [](const LinkSetup&, const LinkTally& t,
                double level) { return figures_of(t.sum.tally).ratio(level); },
    .describe =
        [](LinkPoint& point, const LinkSetup& setup, const LinkTally& tally) {
          put_counts(point, tally);
          describe_link(point, setup.link);
        },
    .fits = fits_link,
    .group = group_size,
    .run_groups = run_link_groups,
    .least_at_once = [](const LinkSetup& setup) { return batch_sizes(setup.link).least; },
    .describe_sweep = describe_rows,
    .loss = [](const LinkSetup&, const LinkTally& t,
               double level) { return figures_of(t.sum.tally).loss(level); },
    .losses = [](const LinkTally& t) { return figures_of(t.sum.tally).losses; }};

LinkPoint run_point(const Link& link, const StopRule& stop, const Workers& workers,
                    const std::function<void(const LinkPoint&)>& meanwhile) {
  const LinkSetup setup{link, workers.profiled};
  CountedRuns<LinkTally> counted;
  const auto point = [&] {
    LinkPoint result{.stop = counted.stop.value_or(StopReason::interrupted), .rule = stop};
    put_counts(result, counted.tally);
    describe_link(result, link);
    return result;
  };
  RunClock clock;
  const AskedRuns asked{.all = static_cast<std::uint32_t>(stop.max_frames), .rule = stop};
  PointCounting(link_measurement, setup, asked, clock).add_to(counted, {workers}, [&] {
    if (meanwhile) meanwhile(point());
  });
  return point();
}

LinkResult run_link(const LoadedScenario& scenario, const Workers& workers) {
  RunCounting counting(link_measurement, scenario);
  for (std::size_t i = 0; i < counting.points().size(); ++i) counting.count(i, {workers});
  counting.describe_sweep();
  return link_result(scenario, "", counting.points());
}

void describe_points(const LoadedScenario& scenario, LinkResult& result) {
  for (LinkPoint& point : result.points)
    if (point.reached())
      describe_link(point, make_link(point_scenario(scenario, point.coordinates)));
  add_row_alarms(result);
}

}  // namespace sim
