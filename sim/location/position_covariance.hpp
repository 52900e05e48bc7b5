#pragma once
// How well a position is known: covariance as the inverse of Fisher's information, its error
// ellipse, and the Cramer-Rao bound. Kay, Fundamentals of Statistical Signal Processing I:
// Estimation Theory (1993), chapter 3: white Gaussian errors of known deviation.
#include <optional>
#include <vector>

#include "sim/location/misfit.hpp"

namespace sim {

struct PositionCovariance {
  double xx = 0, xy = 0, yy = 0;  // m2

  /// Root of the trace: the rms distance from the mean.
  double rms() const;
};

struct ErrorEllipse {
  double semi_major_m = 0, semi_minor_m = 0;
  dsp::Radians direction;  // of the major axis from +x, above -pi/2 to pi/2
};

/// Quantile .95 of chi-square with two degrees of freedom: -2 ln(.05).
inline constexpr double chi_square_95 = 5.991464547107979;

/// The ellipse that holds the truth with probability .95.
ErrorEllipse error_ellipse(const PositionCovariance& covariance);

/// Squared distance from the ellipse's centre in deviations: chi-square with two degrees of
/// freedom for the truth.
double squared_deviations(const PositionCovariance& covariance, double dx, double dy);

/// Inverse of the information, J^T J, of which it gives the position's part; nothing where the rows
/// do not determine all unknowns.
std::optional<PositionCovariance> position_covariance(const std::vector<MisfitRow>& rows,
                                                      bool intensity_unknown);

/// The Cramer-Rao bound on the covariance of unbiased estimates from such readings of a device at
/// `device`; what they measured does not matter, only places and deviations.
std::optional<PositionCovariance> cramer_rao_bound(const LightModel& model,
                                                   const std::vector<Reading>& readings,
                                                   const Position& device, bool intensity_unknown);

}  // namespace sim
