#pragma once
// The complex baseband of a real signal around a carrier, at a rate of about 50 kHz: mixed down,
// low-passed by a Blackman-windowed sinc (Harris 1978; stop-band 74 dB from half the new rate on,
// flat to a fifth of it) and decimated. No delay; the filter sees zeros before and behind.
#include <complex>
#include <span>
#include <vector>

#include "dsp/units.hpp"

namespace sim {

struct Baseband {
  /// The carrier's complex amplitude: of A cos(2 pi f t + p) it is A exp(i p).
  std::vector<std::complex<float>> samples;
  dsp::Hertz sample_rate;  // a whole fraction of the signal's
};

/// The rate is at least four times the carrier: below, the mixer's image would come near it.
Baseband baseband_of(std::span<const float> signal, dsp::Hertz sample_rate, dsp::Hertz carrier);

}  // namespace sim
