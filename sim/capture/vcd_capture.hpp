#pragma once
// VCD, the value change dump of IEEE 1364-2005 clause 18, of any timescale: the one-bit wires by
// their names (wire_names.hpp). Vectors, reals, strings and events are skipped. 0 and 1 are levels,
// and so are L and H of VHDL simulators (IEEE 1164-1993); x, z, U, W and - leave a wire at its last
// known level. The first level of a wire is its initial one if it comes at the file's first time.
// Read though the standard has it not: a time with a fraction, a blank between a value and its
// code, and no timescale if settings.tick says it. An extended VCD (18.3), which says for each
// port who drives it, is refused. So are declarations of over 96 MiB, half a million of them.
#include <iosfwd>
#include <memory>
#include <string>

#include "sim/capture/capture_file.hpp"

namespace sim {

/// `in` must outlive the capture; `file` names it in messages.
std::unique_ptr<LogicCapture> open_vcd(std::istream& in, std::string file,
                                       const CaptureSettings& settings, CaptureFacts& facts);

}  // namespace sim
