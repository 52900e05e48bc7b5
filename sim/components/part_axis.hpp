#pragma once
// Axes of parts: what "*" stands for, and the scenario with each part of the axis in its slot.
#include <functional>
#include <string>
#include <vector>

#include "sim/components/parts.hpp"
#include "sim/scenario/axis.hpp"
#include "sim/scenario/scenario.hpp"

namespace sim {

/// A scenario and the files of its parts.
struct Assembly {
  Scenario scenario;
  std::vector<CarriedPart> parts;
};

/// Makes the scenario with the part of this name under the axis' key; throws if there is none.
using AssembleWith = std::function<Assembly(const std::string& part)>;

/// A part for `axis` that can stand in while others are loaded: its first, or the first of "*".
std::string any_part(const Axis& axis, const PartSources& from, const std::string& place);

/// The scenarios with each part of the axis, in its order. The labels become the parts' own names;
/// "*" becomes all parts that are to be had, by name. Throws for one that comes twice.
std::vector<Assembly> load_part_axis(Axis& axis, const PartSources& from, const std::string& place,
                                     const AssembleWith& assemble);

}  // namespace sim
