#pragma once
// What cosys-sim run and report do with a scenario that is no link: a row of the table in
// experiments.cpp for each experiment (sim/scenario/experiment_kind).
#include <string>

#include "sim/page/report_part.hpp"
#include "sim/report/experiment_run.hpp"
#include "sim/result/stored_dataset.hpp"
#include "sim/scenario/scenario.hpp"

namespace sim {

/// Throws for keys that mean nothing in the scenario's experiment, and for what is wrong at any of
/// its points.
void check_experiment(const LoadedScenario& scenario);

/// Null for a link.
const ExperimentEngine* engine_of(const LoadedScenario& scenario);

/// What a result brings to a report; the name is that of its file.
using ReportExperiment = ReportPart (*)(const std::string& name, const StoredDataset&);

/// Nothing for a link.
ReportExperiment reporter_of(const LoadedScenario& scenario);

}  // namespace sim
