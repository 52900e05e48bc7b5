#pragma once
// Pulse text (.ook) as rtl_433 reads and writes it: a line for each pulse of light and the gap
// behind it, whole numbers of the file's timescale. The one wire, rx, is 0 in light and begins
// idle. What no pulse tells of, the time between two of rtl_433's packages, is left out.
#include <iosfwd>
#include <memory>
#include <string>

#include "sim/capture/logic_capture.hpp"

namespace sim {

/// `in` must outlive the capture; `file` names it in messages.
std::unique_ptr<LogicCapture> open_pulses(std::istream& in, std::string file);

}  // namespace sim
