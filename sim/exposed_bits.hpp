#pragma once
// The bits of a trial whose errors count: all of its last message, and the last character of the
// message before, since a decoder that missed the end of that line loses the next one with it.
#include <vector>

#include "dsp/units.hpp"
#include "sim/trial.hpp"

namespace sim {

struct ExposedBit {
  dsp::Seconds begin, end;
  bool light;
};

/// Bits in order, a list for each stretch of a message.
std::vector<std::vector<ExposedBit>> exposed_bits(const Link& link, const Transmission& sent);

}  // namespace sim
