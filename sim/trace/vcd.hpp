#pragma once
// VCD, the value change dump of IEEE 1364-2005 clause 18: wires out to logic analysers and
// simulators, on a grid of 1 us. They are read by sim/capture/vcd_capture.
#include <iosfwd>
#include <span>
#include <string>

#include "dsp/logic_trace.hpp"

namespace sim {

struct VcdWire {
  std::string name;  // not empty, no white space
  const dsp::LogicTrace* trace = nullptr;
};

/// From time 0 to `duration`. Edges are rounded to the nearest microsecond; of several in one
/// microsecond the level after the last is kept. An edge at 0 becomes the initial level. At the end
/// the levels stand once more, as some readers end at the last one.
void write_vcd(std::ostream& out, std::span<const VcdWire> wires, dsp::Seconds duration);

}  // namespace sim
