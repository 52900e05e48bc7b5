#pragma once
// What a UART line is like, found in a stretch of it: which level is idle, and the bit rate.
//
// Idle is the level of the longest stretch, where that is at least twice as long as the longest at
// the other level: 8N1 is never at the start bit's level for more than nine bits, but idles longer.
// Where it is not, the level that gives more characters without a framing error.
//
// The bit is the longest time T of which nearly all distances from fall to fall are whole multiples
// and nearly all light pulses whole multiples but for one and the same excess of at most 0.35 T
// (pulse-width distortion moves rises against falls, never falls against falls).
#include <optional>
#include <span>

#include "dsp/units.hpp"

namespace sim {

/// Flips of a line from its start on; the level before the first of them.
struct LineStretch {
  bool initial = true;
  std::span<const dsp::Seconds> flips;
  dsp::Seconds end;
};

struct LineFacts {
  bool inverted = false;  // idle is low: light is 1
  dsp::Hertz baud{600};
};

/// What is told is kept; what is found is at most 1 MBd. A line that tells nothing is idle high, of
/// 600 Bd. A rate within 2.5 % of a standard one is that.
LineFacts survey_line(const LineStretch& line, std::optional<bool> inverted,
                      std::optional<dsp::Hertz> baud);

}  // namespace sim
