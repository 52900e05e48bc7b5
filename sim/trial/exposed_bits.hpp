#pragma once
// The bits of a trial whose errors count: all of its last message and of the message before. A
// decoder that missed the end of that line loses the next one with it; and a UART that missed the
// start of a character reads on out of step, and may swallow the end of the line even from afar.
#include <vector>

#include "dsp/units.hpp"
#include "sim/trial/trial.hpp"

namespace sim {

struct ExposedBit {
  dsp::Seconds begin, end;
  bool light;
  double share;  // about how often its error counts, as against others
};

/// Bits in order, a list for each stretch of a message.
std::vector<std::vector<ExposedBit>> exposed_bits(const Link& link, const Transmission& sent);

}  // namespace sim
