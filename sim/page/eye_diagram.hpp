#pragma once
// The eye of a trial: a module's integrator over two bits, all bits of the message over each other,
// those that are wrong at the pin on top.
#include "sim/page/page.hpp"
#include "sim/page/shown_trial.hpp"

namespace sim {

/// As SVG, with the levels at which the pin switches and where a bit is read; of a trial whose
/// integrator was recorded.
std::string eye_as_svg(const ShownTrial& shown);

/// The picture, and what it shows in words.
PagePicture eye_picture(const ShownTrial& shown);

}  // namespace sim
