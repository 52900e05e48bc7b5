#include "sim/arena/arena_experiment.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "channel/instruction_set.hpp"
#include "sim/point_scenario.hpp"
#include "sim/run_sharing.hpp"
#include "sim/sweep.hpp"

namespace sim {
namespace {

/// Characters that all devices send in a run, about.
double characters(const Arena& arena) {
  double sum = 0;
  for (const Sender& sender : arena.senders)
    sum += mean_load(sender) * (arena.end / frame_time(sender, 1));
  return sum;
}

std::vector<SenderFacts> facts_of(const Arena& arena) {
  std::vector<SenderFacts> facts;
  for (std::size_t i = 0; i < arena.senders.size(); ++i)
    facts.push_back({arena.senders[i].name, arena.senders[i].kind, arena.light[i].highest()});
  return facts;
}

ArenaPoint run_point(const Scenario& scenario, const std::vector<double>& coordinates,
                     const ArenaOptions& options) {
  const Arena arena = make_arena(scenario, options.threads, options.interrupt);
  if (is_stopped(options.interrupt)) return {.coordinates = coordinates};
  ArenaPoint point = arena_point(arena, coordinates);
  RunSharing<ArenaRuns> sharing(
      {.runs = static_cast<std::uint32_t>(scenario.arena.runs),
       .most_at_once = runs_that_fit(arena, options.threads),
       .threads = options.threads,
       .stop = options.interrupt},
      [&](std::uint32_t first, int n) { return run_arena(arena, first, n, options.interrupt); });
  for (ArenaRuns& lot : sharing()) add_runs(point, std::move(lot));
  return point;
}

double share_of_time(const ArenaPoint& point, std::uint64_t airtime_us) {
  return static_cast<double>(airtime_us) * 1e-6 /
         (point.duration_s * static_cast<double>(point.tally.n_runs));
}

}  // namespace

std::uint32_t runs_that_fit(const Arena& arena, int threads) {
  constexpr double most_characters = 2.5e6;
  return static_cast<std::uint32_t>(std::clamp(most_characters / (characters(arena) * threads + 1),
                                               1.0,
                                               static_cast<double>(channel::trials_at_once())));
}

ArenaPoint arena_point(const Arena& arena, const std::vector<double>& coordinates) {
  return {.coordinates = coordinates,
          .senders = facts_of(arena),
          .duration_s = arena.duration.value,
          .reach_mw_per_m2 = arena.reach_mw_per_m2,
          .outside = arena.outside};
}

void add_runs(ArenaPoint& point, ArenaRuns runs) {
  point.tally += runs.tally;
  std::ranges::move(runs.heard, std::back_inserter(point.heard));
}

Estimate frame_loss(const SenderTally& tally) {
  constexpr double level = 0.95;
  return clustered_ratio(tally.losses, level);
}

SenderTally together(const ArenaPoint& point) {
  SenderTally sum;
  for (const SenderTally& sender : point.tally.senders) sum += sender;
  sum.losses = point.tally.losses;
  return sum;
}

double offered_load(const ArenaPoint& point, const SenderTally& tally) {
  return share_of_time(point, tally.airtime_in_reach_us);
}

double throughput(const ArenaPoint& point, const SenderTally& tally) {
  return share_of_time(point, tally.airtime_delivered_us);
}

double pure_aloha(double load) { return load * std::exp(-2 * load); }

std::vector<ArenaPoint> run_arenas(const LoadedScenario& scenario, const ArenaOptions& options) {
  std::vector<ArenaPoint> points(count_points(scenario.sweep));
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].coordinates = point_coordinates(scenario.sweep, i);
    if (is_stopped(options.interrupt)) continue;
    points[i] =
        run_point(point_scenario(scenario, points[i].coordinates), points[i].coordinates, options);
    if (options.on_point && points[i].tally.n_runs > 0) options.on_point(points[i]);
  }
  return points;
}

}  // namespace sim
