#include "sim/arena/arena_experiment.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "channel/instruction_set.hpp"

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
                     const Workers& workers) {
  const Arena arena = make_arena(scenario, workers);
  if (workers.interrupted()) return {.coordinates = coordinates};
  ArenaPoint point = arena_point(arena, coordinates);
  RunSharing<ArenaRuns> sharing(
      shared_arena_runs(scenario, arena, workers),
      [&](std::uint32_t first, int n) { return run_arena(arena, first, n, workers.interrupt); });
  for (ArenaRuns& lot : sharing()) add_runs(point, std::move(lot));
  return point;
}

/// Runs that each thread may do at once: as many as there are lanes, but all of them, at some 140
/// bytes a character that devices send, are to take no more than 350 MB.
std::uint32_t runs_that_fit(const Arena& arena, int threads) {
  constexpr double most_characters = 2.5e6;
  return static_cast<std::uint32_t>(std::clamp(most_characters / (characters(arena) * threads + 1),
                                               1.0,
                                               static_cast<double>(channel::trials_at_once())));
}

double share_of_time(const ArenaPoint& point, std::uint64_t airtime_us) {
  return static_cast<double>(airtime_us) * 1e-6 /
         (point.duration_s * static_cast<double>(point.tally.n_runs));
}

}  // namespace

SharedRuns shared_arena_runs(const Scenario& scenario, const Arena& arena, const Workers& workers) {
  return {.runs = static_cast<std::uint32_t>(scenario.arena.runs),
          .most_at_once = runs_that_fit(arena, workers.threads),
          .workers = workers};
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

std::vector<ArenaPoint> run_arenas(const LoadedScenario& scenario, const Workers& workers,
                                   const OnPoint<ArenaPoint>& on_point) {
  return run_points<ArenaPoint>(scenario, workers, on_point, run_point);
}

}  // namespace sim
