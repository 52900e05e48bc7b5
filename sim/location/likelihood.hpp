#pragma once
// How likely readings are of a device at a place, of whatever intensity if that is unknown (profile
// likelihood). Murphy & van der Vaart, On profile likelihood, J. Am. Stat. Assoc. 95 (2000)
// 449-465: of the truth it is below the best by half a chi-square, whose degrees of freedom are the
// two of a place.
#include "sim/location/gauss_newton.hpp"

namespace sim {

class Likelihood {
 public:
  /// Both must outlive it. `scattered` is of the problem's readings.
  Likelihood(const LeastSquares& problem, const ScatteredLight& scattered)
      : problem_(problem), scattered_(scattered) {}

  /// -2 ln of it, but for a constant: chi-square, where deviations are known. Infinite where no
  /// device can be.
  double operator()(const Position& at) const;

 private:
  double of_intensities(const std::vector<double>& light) const;
  double of_shares(const std::vector<double>& light) const;
  double of_bearings(const Position& at) const;

  const LeastSquares& problem_;
  const ScatteredLight& scattered_;
};

}  // namespace sim
