#include "sim/command/run_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/command/experiments.hpp"
#include "sim/engine/engine.hpp"
#include "sim/engine/plan.hpp"
#include "sim/failure.hpp"
#include "sim/report/plan_report.hpp"
#include "sim/scenario/experiment_kind.hpp"
#include "sim/scenario/keys.hpp"
#include "sim/text/standard_output.hpp"

namespace sim {

namespace {

std::vector<RunPilot> pilots_of(const ExperimentEngine& engine, const RunRequest& request,
                                const LoadedScenario& scenario, const Shard& shard,
                                const std::atomic<bool>& interrupt) {
  return engine.pilots(scenario, shard,
                       {.threads = threads_for(request.threads), .interrupt = &interrupt});
}

std::uint64_t units_within(const RunRequest& request, const LoadedScenario& scenario,
                           const std::atomic<bool>& interrupt) {
  if (const ExperimentEngine* engine = engine_of(scenario))
    return runs_within(pilots_of(*engine, request, scenario, {}, interrupt), request.time_budget_s,
                       find_key(amount_key(scenario.base))->facts.range.high);
  return frames_within(run_pilots(scenario, {}, threads_for(request.threads), interrupt),
                       request.time_budget_s);
}

}  // namespace

bool print_plan(const RunRequest& request, const LoadedScenario& scenario,
                const std::atomic<bool>& interrupt) {
  const int threads = threads_for(request.threads);
  if (const ExperimentEngine* engine = engine_of(scenario))
    print(plan_table(scenario.sweep,
                     pilots_of(*engine, request, scenario, request.shard, interrupt), threads));
  else
    print(plan_table(scenario.sweep, run_pilots(scenario, request.shard, threads, interrupt),
                     threads));
  return !interrupt;
}

LoadedScenario within_budget(const RunRequest& request, const LoadedScenario& scenario,
                             const std::atomic<bool>& interrupt) {
  const std::string key = amount_key(scenario.base);
  if (std::ranges::find(scenario.sweep, key, &Axis::key) != scenario.sweep.end())
    throw bad_input("--time-budget", key + " is swept in " + scenario.path.string(),
                    "leave one of the two out");
  const std::uint64_t units = units_within(request, scenario, interrupt);
  if (interrupt) return scenario;
  ScenarioOptions options = request.options;
  options.overrides.push_back(fmt::format("{}={}", key, units));
  const bool link = engine_of(scenario) == nullptr;
  say(fmt::format(
      "cosys-sim: {}: {} chosen\n", scenario.path.string(),
      link ? fmt::format("--max-frames {}", units) : fmt::format("--set {}={}", key, units)));
  return load_with(options, scenario.path);
}

}  // namespace sim
