#pragma once
// VCD, the value change dump of IEEE 1364-2005 clause 18, of any timescale: the one-bit wires in
// the order of their declaration, without their scopes. Vectors, reals, strings and events are
// skipped, and of several names of one wire the first counts. x and z leave a wire at its last
// known level. The first level of a wire is its initial one if it comes at the file's first time.
// Declarations that would take over 64 MiB, half a million of them, are refused.
#include <iosfwd>
#include <memory>
#include <string>

#include "sim/capture/logic_capture.hpp"

namespace sim {

/// `in` must outlive the capture; `file` names it in messages.
std::unique_ptr<LogicCapture> open_vcd(std::istream& in, std::string file);

}  // namespace sim
