#pragma once
// Numbers below the pictures of a trial: its characters one by one, and how open the eye is.
#include "sim/page/page.hpp"
#include "sim/trace/trace.hpp"

namespace sim {

/// A row for each character that was sent: when it begins, in ms since the message did, what was
/// read in its place, and how many of its ten bits are wrong at the pin.
PageTable characters_table(const TracedTrial& trial);

/// A row for each eighth of a bit since the sender's bit began, up to one and a half: what the
/// integrator has at least of bits of light and at most of dark ones, in samples, and how far these
/// are apart, or that they are not; of a trial whose integrator was recorded.
PageTable eye_table(const TracedTrial& trial);

}  // namespace sim
