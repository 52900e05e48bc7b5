#include "sim/command/experiments.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <deque>
#include <vector>

#include "sim/arena/arena_check.hpp"
#include "sim/arena/arena_keys.hpp"
#include "sim/arena/arena_report.hpp"
#include "sim/arena/arena_section.hpp"
#include "sim/false_accepts/false_accept_experiment.hpp"
#include "sim/false_accepts/false_accept_keys.hpp"
#include "sim/false_accepts/false_accept_report.hpp"
#include "sim/false_accepts/false_accept_section.hpp"
#include "sim/guard/guard_check.hpp"
#include "sim/guard/guard_keys.hpp"
#include "sim/guard/guard_report.hpp"
#include "sim/guard/guard_section.hpp"
#include "sim/link_experiment/link_measurement.hpp"
#include "sim/link_experiment/link_report.hpp"
#include "sim/location/accuracy_report.hpp"
#include "sim/location/location_keys.hpp"
#include "sim/location/location_sections.hpp"
#include "sim/location/presence_report.hpp"
#include "sim/report/point_run.hpp"
#include "sim/section/columns_section.hpp"
#include "sim/shared_link/shared_link_check.hpp"
#include "sim/shared_link/shared_link_keys.hpp"
#include "sim/shared_link/shared_link_report.hpp"
#include "sim/shared_link/shared_link_section.hpp"

namespace sim {
namespace {

template <const auto& measurement, const auto& report>
constexpr const ExperimentEngine* engine = &experiment_engine<measurement, report>;

constexpr std::array shipped{
    Experiment{&arena_kind, engine<arena_measurement, arena_report>, check_arena, arena_section},
    Experiment{&guard_kind, engine<guard_measurement, guard_report>, check_guard, guard_section},
    Experiment{&shared_link_kind, engine<shared_link_measurement, shared_link_report>,
               check_shared_link, shared_link_section},
    Experiment{&presence_kind, engine<presence_measurement, presence_report>, nullptr,
               presence_section},
    Experiment{&location_kind, engine<location_measurement, location_report>, nullptr,
               location_section},
    Experiment{&false_accept_kind, engine<false_accept_measurement, false_accept_report>,
               check_false_accepts, false_accept_section},
};

/// Its kind is known from the start; its reports are not made of a Dataset.
constexpr Experiment link{&link_kind, engine<link_measurement, link_report>};

std::vector<const Experiment*>& known() {
  static std::vector<const Experiment*> experiments{&link};
  return experiments;
}

/// From the program's start on.
const std::deque<KnownExperiment> shipped_are_known(shipped.begin(), shipped.end());

const Experiment& experiment_of(const LoadedScenario& scenario) {
  const auto found = std::ranges::find(known(), &kind_of(scenario.base), &Experiment::kind);
  assert(found != known().end());
  return **found;
}

}  // namespace

KnownExperiment::KnownExperiment(const Experiment& experiment)
    : experiment_(&experiment), kind_(*experiment.kind) {
  known().push_back(experiment_);
}

KnownExperiment::~KnownExperiment() { std::erase(known(), experiment_); }

void check_experiment(const LoadedScenario& scenario) {
  check_keys_of_experiment(scenario);
  const Experiment& experiment = experiment_of(scenario);
  if (experiment.check != nullptr) experiment.check(scenario);
}

const ExperimentEngine& engine_of(const LoadedScenario& scenario) {
  return *experiment_of(scenario).engine;
}

ReportSection report_of(const std::string& name, const StoredDataset& stored) {
  const Experiment& experiment = experiment_of(stored.scenario);
  return experiment.report != nullptr ? experiment.report(name, stored)
                                      : columns_section(name, stored, experiment.engine->columns());
}

}  // namespace sim
