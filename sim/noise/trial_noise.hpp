#pragma once
// The part of a trial's noise that importance sampling draws anew: the standard normals of some
// stretches of samples, numbers read off them, and noise changed so that these numbers are wanted
// ones.
#include <cstdint>
#include <span>
#include <vector>

#include "channel/noise_window.hpp"
#include "dsp/philox.hpp"

namespace sim {

/// Samples [first, first + n) of a trial.
struct Stretch {
  std::int64_t first = 0, n = 0;
  std::int64_t end() const { return first + n; }
};

/// A number that noise makes somewhere in the receiver: its normals from sample `first` on times
/// these coefficients, whose squares add up to 1. So it is a standard normal itself. Of a tone at
/// some phase they are a mixture of two rows, its cosine and its sine, which all phases share.
struct NoiseReading {
  std::int64_t first = 0;
  std::span<const float> coefficients{};
  float factor = 1, sine_factor = 0;  // unless that is 0, as many coefficients of the sine follow
};

double covariance(const NoiseReading& a, const NoiseReading& b);

class TrialNoise {
 public:
  /// Draws the normals of stretches that are in order and apart.
  TrialNoise(const std::vector<Stretch>& stretches, const dsp::RandomAddress& draws);
  TrialNoise(const TrialNoise&) = delete;
  TrialNoise(TrialNoise&&) = default;

  /// What it reads; the whole reading must be within one stretch.
  double value(const NoiseReading& reading) const;
  /// Adds the reading's coefficients times `factor` to the noise.
  void add(const NoiseReading& reading, double factor);

  /// For the chain; they point into this, and stay where they are when it is moved.
  std::span<const channel::NoiseWindow> windows() const { return windows_; }

 private:
  std::size_t place_of(const NoiseReading& reading) const;

  std::vector<float> normals_;
  std::vector<channel::NoiseWindow> windows_;
};

}  // namespace sim
