#include "sim/command/run_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>

#include "sim/command/experiments.hpp"
#include "sim/failure.hpp"
#include "sim/scenario/experiment_kind.hpp"
#include "sim/text/standard_output.hpp"

namespace sim {

LoadedScenario within_budget(const RunRequest& request, const LoadedScenario& scenario,
                             const Workers& workers) {
  const std::string key = amount_key(scenario.base);
  if (std::ranges::find(scenario.sweep, key, &Axis::key) != scenario.sweep.end())
    throw bad_input("--time-budget", key + " is swept in " + scenario.path.string(),
                    "leave one of the two out");
  const std::uint64_t amount =
      engine_of(scenario).amount_within(scenario, request.time_budget_s, workers);
  if (workers.interrupted()) return scenario;
  ScenarioOptions options = request.options;
  options.overrides.push_back(fmt::format("{}={}", key, amount));
  say(fmt::format("cosys-sim: {}: --max-frames {} chosen\n", scenario.path.string(), amount));
  return load_with(options, scenario.path);
}

}  // namespace sim
