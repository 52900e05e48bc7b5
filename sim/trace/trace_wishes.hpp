#pragma once
#include <string>

#include "dsp/units.hpp"

namespace sim {

/// What a file of a traced trial shall have otherwise than usual. Not each format can.
struct TraceWishes {
  std::string pin;      // a name for the wire rx, without white space; empty: rx
  dsp::Seconds tail{};  // for so long the wires stay as they are after the trial
  bool taps = false;    // beside the wires, where a format has them without
};

}  // namespace sim
