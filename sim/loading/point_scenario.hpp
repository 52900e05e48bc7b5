#pragma once
// The points of a loaded scenario. Loading checks each of them once (check_all_points): keys that
// contradict each other are refused, be it at one point of a sweep only.
#include <cstdint>
#include <string>
#include <vector>

#include "sim/counting/stop_rule.hpp"
#include "sim/scenario/scenario.hpp"

namespace sim {

/// The scenario of one point of the sweep, a coordinate an axis.
Scenario point_scenario(const LoadedScenario& loaded, const std::vector<double>& coordinates);

/// The same beside the points of the sweep; throws if its keys contradict each other.
Scenario checked_point(const LoadedScenario& loaded, const std::vector<double>& coordinates);

/// The same by the point's number, counted from 0, as of --point; throws if there is no such point.
Scenario numbered_point(const LoadedScenario& loaded, std::uint64_t number);

StopRule rule_of(const StopSettings& stop);

/// Throw unless every point of the sweep holds.
void check_all_points(const LoadedScenario& loaded);

/// Throws where the LED's data do not tell of that temperature.
void check_led_temperature(const channel::EmitterData& emitter, double celsius,
                           const SourceLocations& places);

/// Throws where the receiver is an ideal one, for experiments that are not of one sender's bits.
void check_receiver_module(const Scenario& scenario, const SourceLocations& places);

}  // namespace sim
