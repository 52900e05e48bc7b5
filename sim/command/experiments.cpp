#include "sim/command/experiments.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "sim/arena/arena_check.hpp"
#include "sim/arena/arena_command.hpp"
#include "sim/arena/arena_part.hpp"
#include "sim/exchange/exchange_check.hpp"
#include "sim/exchange/exchange_command.hpp"
#include "sim/exchange/exchange_part.hpp"
#include "sim/guard/guard_check.hpp"
#include "sim/guard/guard_command.hpp"
#include "sim/guard/guard_part.hpp"
#include "sim/listening/listening_experiment.hpp"
#include "sim/listening/listening_part.hpp"
#include "sim/listening/listening_report.hpp"
#include "sim/location/location_parts.hpp"
#include "sim/location/trial_commands.hpp"
#include "sim/scenario/experiment_kind.hpp"

namespace sim {
namespace {

struct Experiment {
  std::string_view name;
  void (*check)(const LoadedScenario&);  // for what the keys alone do not show
  const ExperimentEngine* engine;
  ReportExperiment report;
};

void nothing_more(const LoadedScenario&) {}

constexpr std::array experiments{
    Experiment{"link", nothing_more, nullptr, nullptr},
    Experiment{"arena", check_arena, &arena_engine, arena_part},
    Experiment{"guard", check_guard, &guard_engine, guard_part},
    Experiment{"sharedlink", check_exchange, &exchange_engine, exchange_part},
    Experiment{"presence", nothing_more, &presence_engine, presence_part},
    Experiment{"location", nothing_more, &location_engine, location_part},
    Experiment{"listening", check_listening, &listening_engine, listening_part},
};

const Experiment& experiment_of(const LoadedScenario& scenario) {
  return *std::ranges::find(experiments, scenario.base.experiment, &Experiment::name);
}

}  // namespace

void check_experiment(const LoadedScenario& scenario) {
  check_keys_of_experiment(scenario);
  experiment_of(scenario).check(scenario);
}

const ExperimentEngine* engine_of(const LoadedScenario& scenario) {
  return experiment_of(scenario).engine;
}

ReportExperiment reporter_of(const LoadedScenario& scenario) {
  return experiment_of(scenario).report;
}

}  // namespace sim
