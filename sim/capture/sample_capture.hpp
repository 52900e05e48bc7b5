#pragma once
// SampleCapture: what an oscilloscope, a sound card or an SDR took of a light or a wire, evenly
// sampled, in memory that does not grow with the file. What cannot be read is thrown as
// Failure(bad_input).
#include <complex>
#include <cstddef>
#include <span>

#include "dsp/units.hpp"

namespace sim {

/// What samplers do, and what counts of samples and of their time have room for.
constexpr bool is_sample_rate(dsp::Hertz rate) { return rate.value >= 1 && rate.value <= 1e12; }

class SampleCapture {
 public:
  SampleCapture() = default;
  SampleCapture(const SampleCapture&) = delete;
  SampleCapture& operator=(const SampleCapture&) = delete;
  virtual ~SampleCapture() = default;

  virtual dsp::Hertz sample_rate() const = 0;  // is_sample_rate()
  /// Whether samples are a baseband (I and Q); else their imaginary part is 0.
  virtual bool is_complex() const = 0;
  /// The next samples, in the file's own unit, all finite; fewer than asked for at the end alone.
  virtual std::size_t read(std::span<std::complex<float>> to) = 0;
};

}  // namespace sim
