#pragma once
// How surely a device is noticed, at all points of a scenario's sweep.
#include "sim/engine/measurement.hpp"
#include "sim/location/presence.hpp"
#include "sim/location/trial_points.hpp"

namespace sim {

using PresencePointRun = TrialPoint<PresenceSettings, PresenceResult>;

extern const Measurement<PresenceBench, PresenceTally, PresencePointRun> presence_measurement;

}  // namespace sim
