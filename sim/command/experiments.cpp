#include "sim/command/experiments.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "sim/arena/arena_check.hpp"
#include "sim/arena/arena_command.hpp"
#include "sim/exchange/exchange_check.hpp"
#include "sim/exchange/exchange_command.hpp"
#include "sim/guard/guard_check.hpp"
#include "sim/guard/guard_command.hpp"
#include "sim/listening/listening_report.hpp"
#include "sim/location/trial_commands.hpp"
#include "sim/scenario/experiment_kind.hpp"

namespace sim {
namespace {

struct Experiment {
  std::string_view name;
  void (*check)(const LoadedScenario&);  // for what the keys alone do not show
  RunExperiment run;
};

void nothing_more(const LoadedScenario&) {}

constexpr std::array experiments{
    Experiment{"link", nothing_more, nullptr},
    Experiment{"arena", check_arena, run_arena_scenario},
    Experiment{"guard", check_guard, run_guard_scenario},
    Experiment{"sharedlink", check_exchange, run_exchange_scenario},
    Experiment{"presence", nothing_more, run_presence_scenario},
    Experiment{"location", nothing_more, run_location_scenario},
    Experiment{"listening", check_listening, run_listening_scenario},
};

const Experiment& experiment_of(const LoadedScenario& scenario) {
  return *std::ranges::find(experiments, scenario.base.experiment, &Experiment::name);
}

}  // namespace

void check_experiment(const LoadedScenario& scenario) {
  check_keys_of_experiment(scenario);
  experiment_of(scenario).check(scenario);
}

RunExperiment runner_of(const LoadedScenario& scenario) { return experiment_of(scenario).run; }

}  // namespace sim
