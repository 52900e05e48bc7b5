#pragma once
// `cosys-sim run` of a scenario of presence or of location.
#include "sim/location/accuracy_report.hpp"
#include "sim/location/presence_report.hpp"
#include "sim/report/experiment_run.hpp"

namespace sim {

extern const Measurement<PresenceBench, PresenceTally, PresencePointRun> presence_measurement;
extern const Measurement<LocationBench, LocationTally, LocationPointRun> location_measurement;

extern const ExperimentEngine presence_engine, location_engine;

}  // namespace sim
