#pragma once
// A module's constants by what its output made of a plan's light: maximum likelihood on the pulses
// of one capture or several, with levels that are known to a few per cent only.
#include <vector>

#include "channel/receiver_module.hpp"
#include "sim/fit/fit_result.hpp"
#include "sim/fit/joined_light.hpp"

namespace sim {

/// Standard deviation of a level against another one, as a share.
inline constexpr double level_error = 0.07;

/// `captures`: at least one. Throws Failure(bad_input) where a recording and its plan have nothing
/// in common.
FittedModule fit_module(const std::vector<LightCapture>& captures, const channel::ModuleData& like);

}  // namespace sim
