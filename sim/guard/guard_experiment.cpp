#include "sim/guard/guard_experiment.hpp"

#include <algorithm>

#include "sim/arena/arena_run.hpp"
#include "sim/guard/guard_check.hpp"
#include "sim/guard/guard_keys.hpp"
#include "sim/trial/trial.hpp"

namespace sim {
namespace {

RelayDesign relay_design(const Scenario& scenario, const Arena& arena) {
  return {.variables = shared_variables(arena.senders),
          .settings = scenario.settings.of<GuardSettings>(),
          .duration = arena.duration,
          .delay = arena.delay};
}

Guard make_guard(const Scenario& scenario, const SourceLocations&, const Workers& workers) {
  Guard guard{make_arena(scenario, workers), {}};
  if (!workers.interrupted()) guard.design = relay_design(scenario, guard.arena);
  return guard;
}

GuardRuns run_guard(const Guard& guard, std::uint32_t first, int n, const std::atomic<bool>* stop) {
  GuardRuns runs{run_arena(guard.arena, first, n, stop), {}};
  for (std::uint32_t run = first; run < first + static_cast<std::uint32_t>(n); ++run) {
    const auto& all = runs.arena.heard;
    const auto begin = std::ranges::lower_bound(all, run, {}, &HeardFrame::run);
    const auto end = std::ranges::upper_bound(all, run, {}, &HeardFrame::run);
    runs.tally += relay(guard.design, {begin, end},
                        {.seed = guard.arena.seed,
                         .point = guard.arena.point,
                         .trial = run,
                         .purpose = static_cast<std::uint32_t>(Purpose::serial_line)},
                        stop);
  }
  return runs;
}

void describe_guard(GuardPoint& point, const Guard& guard, const GuardRuns& runs) {
  describe_arena(point, guard.arena, runs.arena);
  point.variables = guard.design.variables;
  point.relayed = runs.tally;
}

}  // namespace

RelayTally relayed_together(const GuardPoint& point) {
  RelayTally sum;
  for (const RelayTally& relay : point.relayed.relays) sum += relay;
  return sum;
}

GuardRuns& GuardRuns::operator+=(const GuardRuns& next) {
  arena += next.arena;
  tally += next.tally;
  return *this;
}

constinit const Measurement<Guard, GuardRuns, GuardPoint> guard_measurement{
    .unreached =
        [](const Scenario&, const SourceLocations&, const std::vector<double>& coordinates) {
          return GuardPoint{{.coordinates = coordinates}};
        },
    .prepare = make_guard,
    .most_at_once = [](const Guard& guard, std::uint32_t,
                       int threads) { return arena_runs_at_once(guard.arena, threads); },
    .run = run_guard,
    .ratio = [](const Guard&, const GuardRuns& runs,
                double level) { return frame_loss(runs.arena, level); },
    .describe = describe_guard,
    .fits =
        [](const Guard& guard, const GuardRuns& runs, std::uint32_t n) {
          return fits_arena(guard.arena, runs.arena, n) &&
                 runs.tally.relays.size() == guard.arena.senders.size();
        }};

}  // namespace sim
