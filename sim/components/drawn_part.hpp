#pragma once
// Drawn parts: a part whose numbers that no document prints are drawn within their bounds.
#include <string>
#include <vector>

#include "channel/receiver_module.hpp"
#include "dsp/philox.hpp"
#include "sim/scenario/scenario.hpp"

namespace sim {

/// The module with each number that has bounds drawn from them. A number's draw depends on its key
/// and on nothing else of the part; only that a greatest Emin is never below the drawn one.
channel::ModuleData with_drawn_numbers(channel::ModuleData module, const dsp::RandomAddress& draws);

/// One unit: centre and threshold as of the population (channel::unit_of), and the numbers that
/// nobody printed.
channel::ModuleData drawn_unit(const channel::ModuleData& module, const dsp::RandomAddress& draws);

/// A number of a unit, as its key in a scenario.
struct DrawnNumber {
  std::string key, unit;
  double value;
};

/// Whether units of the scenario's parts differ: a module of more than theory, or bounds of LED or
/// floor.
bool has_unlike_units(const Scenario& scenario);

/// What was drawn of the parts of a scenario in which a unit was placed.
std::vector<DrawnNumber> drawn_numbers(const Scenario& scenario);

/// Takes the bounds of those numbers off the scenario's parts that the scenario itself gives.
void forget_given_bounds(Scenario& scenario, const SourceLocations& places);

/// Whether each point of a sweep has a unit of its own; else the base has that of all.
bool is_drawn_by_point(const std::vector<Axis>& sweep);

/// Puts unit number receiver.unit in the place of module, LEDs and floor; 0 leaves them as they
/// are. A unit has the same numbers at every point of a sweep. What is not known of an LED is drawn
/// alike for all devices that have it.
void place_unit(Scenario& scenario);

}  // namespace sim
