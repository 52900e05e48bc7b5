#pragma once
// VCD, the value change dump of IEEE 1364-2005 clause 18: wires out to logic analysers and
// simulators, captures of theirs in. Written files are on a grid of 1 us; read files may have any
// timescale. Reading garbage ends in a Failure with its line number, and in memory proportional to
// the file.
#include <iosfwd>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dsp/logic_trace.hpp"

namespace sim {

struct VcdWire {
  std::string name;  // not empty, no white space
  const dsp::LogicTrace* trace = nullptr;
};

/// From time 0 to `duration`. Flips are rounded to the nearest microsecond; of several in one
/// microsecond the level after the last is kept. A flip at 0 becomes the initial level.
void write_vcd(std::ostream& out, std::span<const VcdWire> wires, dsp::Seconds duration);

struct VcdTrace {
  std::string name;  // reference with its bit select, without its scopes
  dsp::LogicTrace trace;
};

/// The one-bit wires in the order of their declaration, observed until the file's last time;
/// vectors, reals, strings and events are skipped, and of several names of one wire the first
/// counts. x and z leave a wire at its last known level; before any it is 1, as an idle line is.
/// `file` names the source in messages.
std::vector<VcdTrace> read_vcd(std::istream& in, std::string_view file);

}  // namespace sim
