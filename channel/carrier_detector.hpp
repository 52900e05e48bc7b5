#pragma once
// Is there a carrier in these samples of a light meter? Three test statistics, each blind to a
// steady light that was there all the time, in units of the noise: with white noise of deviation 1
// a sample and no light, the first and third are standard normal and the second is chi-square with
// two degrees of freedom, exactly, for any frequency and length. Kay, Fundamentals of Statistical
// Signal Processing II: Detection Theory (1998), chapter 4 (matched filter) and theorem 7.1.
#include <cstddef>
#include <span>
#include <vector>

namespace channel {

/// Phase known: correlates with a replica of the carrier, from which the mean is taken off. With
/// light the statistic is normal around the root of the energy of what varies in the replica.
class SynchronousDetector {
 public:
  /// `replica`: samples of the light that is looked for, in any unit, without noise.
  explicit SynchronousDetector(std::span<const double> replica);
  /// The replica does not vary: sampled at a divisor of the carrier it looks like steady light.
  bool blind() const { return reference_.empty(); }
  /// As many samples as the replica has. Not to be called where blind.
  double operator()(std::span<const double> samples) const;

 private:
  std::vector<double> reference_;  // of unit energy, sums to 0
};

/// Phase unknown: the power at one frequency, by Goertzel's recursion, which need not be a whole
/// number of cycles in the window. What a finite window mixes (cosine, sine and mean) is unmixed,
/// which makes it the generalised likelihood ratio test: with light noncentral chi-square.
class GoertzelDetector {
 public:
  /// A frequency above half a cycle a sample is that of its alias.
  GoertzelDetector(double cycles_per_sample, std::size_t samples);
  /// The carrier's alias is 0 or half the sample rate, so it has no phase to be found.
  bool blind() const { return determinant_ == 0; }
  /// As many samples as were announced. Not to be called where blind.
  double operator()(std::span<const double> samples) const;

 private:
  double radians_;  // a sample
  std::size_t samples_;
  double cc_ = 0, cs_ = 0, ss_ = 0;  // products of cosine and sine over the window, means taken off
  double determinant_ = 0;
};

/// Broadband: how much more light than in a reference window, whatever it is.
double dc_difference(std::span<const double> samples, std::span<const double> reference);

}  // namespace channel
