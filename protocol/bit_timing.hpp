#pragma once
// A sender's bit period and what the receiver module does to its pulses, from the pulses alone:
// falls of one sender are whole bits apart, and its pulses are whole bits long, all of them longer
// or shorter by the same time (TSOP data sheets: output pulse width).
#include <span>
#include <vector>

#include "protocol/light_pulses.hpp"

namespace protocol {

struct BitTiming {
  dsp::Seconds period;
  dsp::Seconds lengthening;  // of each pulse of light; negative where they are shortened
};

/// Of all pulses of one sender, whose clock is off by up to `most_clock_error`. Pulses that noise
/// made or split are outvoted as long as they are fewer than half.
BitTiming estimate_bit_timing(std::span<const LightPulse> pulses, dsp::Seconds nominal_period);

/// What the light was before the module. Pulses that meet become one.
std::vector<LightPulse> without_lengthening(std::span<const LightPulse> pulses,
                                            dsp::Seconds lengthening);

/// COSYS names none; this is what a UART stands on a line without noise.
inline constexpr double most_clock_error = 0.05;

}  // namespace protocol
