#include "sim/command/run_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/engine/engine.hpp"
#include "sim/engine/plan.hpp"
#include "sim/failure.hpp"
#include "sim/report/plan_report.hpp"
#include "sim/text/standard_output.hpp"

namespace sim {

bool print_plan(const RunRequest& request, const LoadedScenario& scenario,
                const std::atomic<bool>& interrupt) {
  const int threads = threads_for(request.threads);
  const std::vector<Pilot> pilots = run_pilots(scenario, request.shard, threads, interrupt);
  print(plan_table(scenario.sweep, pilots, threads));
  return !interrupt;
}

LoadedScenario within_budget(const RunRequest& request, const LoadedScenario& scenario,
                             const std::atomic<bool>& interrupt) {
  const std::string key = "stop.max_frames";
  const auto is_of_frames = [&](const Axis& axis) { return axis.key == key; };
  if (std::ranges::any_of(scenario.sweep, is_of_frames))
    throw bad_input("--time-budget", key + " is swept in " + scenario.path.string(),
                    "leave one of the two out");
  const std::vector<Pilot> pilots =
      run_pilots(scenario, {}, threads_for(request.threads), interrupt);
  if (interrupt) return scenario;
  const std::uint64_t frames = frames_within(pilots, request.time_budget_s);
  ScenarioOptions options = request.options;
  options.overrides.push_back(fmt::format("{}={}", key, frames));
  say(fmt::format("cosys-sim: {}: --max-frames {} chosen\n", scenario.path.string(), frames));
  return load_with(options, scenario.path);
}

}  // namespace sim
