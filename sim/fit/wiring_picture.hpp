#pragma once
// The wires of the bench as a drawing: Arduino, LED with its resistors, receiver module with what
// its sheet wants at the supply, and where an analyser may listen.
#include <string>

namespace sim {

/// As SVG; `module` is the one that the plan is for.
std::string wiring_as_svg(const std::string& module, double distance_m);

}  // namespace sim
