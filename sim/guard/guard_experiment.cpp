#include "sim/guard/guard_experiment.hpp"

#include <algorithm>
#include <utility>

#include "sim/arena/arena_run.hpp"
#include "sim/guard/guard_check.hpp"
#include "sim/guard/mirror.hpp"
#include "sim/trial/trial.hpp"

namespace sim {
namespace {

MirrorDesign mirror_design(const Scenario& scenario, const Arena& arena) {
  return {.variables = shared_variables(arena.senders),
          .settings = scenario.guard,
          .duration = arena.duration,
          .delay = arena.delay};
}

struct GuardRuns {
  ArenaRuns arena;
  GuardTally tally;
};

GuardRuns run_lot(const Arena& arena, const MirrorDesign& design, std::uint32_t first, int n,
                  const std::atomic<bool>* stop) {
  GuardRuns runs{run_arena(arena, first, n, stop), {}};
  for (std::uint32_t run = first; run < first + static_cast<std::uint32_t>(n); ++run) {
    const auto& all = runs.arena.heard;
    const auto begin = std::ranges::lower_bound(all, run, {}, &HeardFrame::run);
    const auto end = std::ranges::upper_bound(all, run, {}, &HeardFrame::run);
    runs.tally += mirror(design, {begin, end},
                         {.seed = arena.seed,
                          .point = arena.point,
                          .trial = run,
                          .purpose = static_cast<std::uint32_t>(Purpose::serial_line)},
                         stop);
  }
  return runs;
}

GuardPoint run_point(const Scenario& scenario, const std::vector<double>& coordinates,
                     const Workers& workers) {
  const Arena arena = make_arena(scenario, workers);
  if (workers.interrupted()) return {.arena = {.coordinates = coordinates}};
  const MirrorDesign design = mirror_design(scenario, arena);
  GuardPoint point{arena_point(arena, coordinates), design.variables, {}};
  RunSharing<GuardRuns> sharing(shared_arena_runs(scenario, arena, workers),
                                [&](std::uint32_t first, int n) {
                                  return run_lot(arena, design, first, n, workers.interrupt);
                                });
  for (GuardRuns& lot : sharing()) {
    add_runs(point.arena, std::move(lot.arena));
    point.tally += lot.tally;
  }
  return point;
}

}  // namespace

MirrorTally together(const GuardPoint& point) {
  MirrorTally sum;
  for (const MirrorTally& mirror : point.tally.mirrors) sum += mirror;
  return sum;
}

std::vector<GuardPoint> run_guards(const LoadedScenario& scenario, const Workers& workers,
                                   const OnPoint<GuardPoint>& on_point) {
  return run_points<GuardPoint>(scenario, workers, on_point, run_point);
}

}  // namespace sim
