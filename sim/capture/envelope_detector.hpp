#pragma once
// Quadrature demodulation: how strong a carrier is at each sample, whatever its phase. The signal
// is turned down by the carrier's frequency and averaged twice over a window of whole carrier
// cycles, where a constant, the carrier's image and its harmonics are gone.
#include <complex>
#include <cstdint>
#include <vector>

#include "dsp/units.hpp"

namespace sim {

/// Mean of the last samples of a signal that was 0 before.
class MovingMean {
 public:
  explicit MovingMean(std::size_t window) : last_(window) {}
  std::complex<double> push(std::complex<double> sample);

 private:
  std::vector<std::complex<double>> last_;
  std::complex<double> sum_;
  std::size_t next_ = 0;
};

class EnvelopeDetector {
 public:
  /// `window` of each average is at least one sample.
  EnvelopeDetector(dsp::Hertz carrier, dsp::Hertz sample_rate, dsp::Seconds window);

  /// The carrier's amplitude, of a real signal half of it, delay() before this sample.
  double push(std::complex<float> sample);
  dsp::Seconds delay() const;

 private:
  dsp::Hertz carrier_, sample_rate_;
  std::size_t window_;
  MovingMean first_, second_;
  std::complex<double> turn_, step_;
  std::uint64_t count_ = 0;
};

}  // namespace sim
