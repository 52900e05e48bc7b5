#pragma once
// How well a device is located, at all points of a scenario's sweep.
#include "sim/engine/measurement.hpp"
#include "sim/location/location_trials.hpp"
#include "sim/location/trial_points.hpp"

namespace sim {

using LocationPointRun = TrialPoint<LocationTrialsSettings, LocationTrials>;

extern const Measurement<LocationBench, LocationTally, LocationPointRun> location_measurement;

}  // namespace sim
