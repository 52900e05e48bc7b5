#pragma once
// The experiments: a row of the table in experiments.cpp for each. A row is all that the commands
// need to know of one.
#include <string>

#include "sim/report/experiment_run.hpp"
#include "sim/result/stored_dataset.hpp"
#include "sim/scenario/experiment_kind.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/section/report_section.hpp"

namespace sim {

/// What a result brings to a report; the name is that of its file.
using ReportExperiment = ReportSection (*)(const std::string& name, const StoredDataset&);

struct Experiment {
  const ExperimentKind* kind;
  const ExperimentEngine* engine;
  void (*check)(const LoadedScenario&) = nullptr;  // for what the keys alone do not show
  ReportExperiment report = nullptr;               // null: made of its columns
};

/// As long as this lives, scenarios may be of an experiment and the commands know it. Not for
/// several threads at once.
class KnownExperiment {
 public:
  /// `experiment` must outlive this.
  explicit KnownExperiment(const Experiment& experiment);
  ~KnownExperiment();
  KnownExperiment(const KnownExperiment&) = delete;
  KnownExperiment& operator=(const KnownExperiment&) = delete;

 private:
  const Experiment* experiment_;
  KnownExperimentKind kind_;
};

/// Throws for keys that mean nothing in the scenario's experiment, and for what is wrong at any of
/// its points.
void check_experiment(const LoadedScenario& scenario);

const ExperimentEngine& engine_of(const LoadedScenario& scenario);

/// What a result that is not of a link brings to a report.
ReportSection report_of(const std::string& name, const StoredDataset& stored);

}  // namespace sim
