#include "sim/location/position_covariance.hpp"

#include <armadillo>
#include <cmath>
#include <numbers>

namespace sim {
namespace {

/// Below it a singular value is rounding: slopes are good to 1e-9 or so.
constexpr double least_singular_value = 1e-6;

}  // namespace

double PositionCovariance::rms() const { return std::sqrt(xx + yy); }

ErrorEllipse error_ellipse(const PositionCovariance& c) {
  const double middle = (c.xx + c.yy) / 2;
  const double radius = std::hypot((c.xx - c.yy) / 2, c.xy);
  return {.semi_major_m = std::sqrt(chi_square_95 * (middle + radius)),
          .semi_minor_m = std::sqrt(chi_square_95 * std::max(0.0, middle - radius)),
          .direction = dsp::Radians(std::atan2(2 * c.xy, c.xx - c.yy) / 2)};
}

double squared_deviations(const PositionCovariance& c, double dx, double dy) {
  return (c.yy * dx * dx - 2 * c.xy * dx * dy + c.xx * dy * dy) / (c.xx * c.yy - c.xy * c.xy);
}

std::optional<PositionCovariance> position_covariance(const std::vector<MisfitRow>& rows,
                                                      bool intensity_unknown) {
  const arma::uword unknowns = intensity_unknown ? 3 : 2;
  arma::mat slopes(rows.size(), unknowns);
  for (arma::uword i = 0; i < slopes.n_rows; ++i)
    for (arma::uword j = 0; j < unknowns; ++j) slopes(i, j) = rows[i].slope[j];
  if (rows.size() < unknowns) return std::nullopt;
  const arma::rowvec scale = arma::sqrt(arma::sum(arma::square(slopes), 0));
  if (!scale.is_finite() || scale.min() <= 0) return std::nullopt;
  arma::mat u, v;
  arma::vec singular;
  if (!arma::svd_econ(u, singular, v, slopes.each_row() / scale)) return std::nullopt;
  if (singular.min() < least_singular_value * singular.max()) return std::nullopt;
  const arma::mat root = (v.each_col() / scale.t()).eval().each_row() / singular.t();
  const arma::mat covariance = root * root.t();
  return PositionCovariance{covariance(0, 0), covariance(0, 1), covariance(1, 1)};
}

std::optional<PositionCovariance> cramer_rao_bound(const LightModel& model,
                                                   const std::vector<Reading>& readings,
                                                   const Position& device, bool intensity_unknown) {
  const ScatteredLight scattered = scattered_light(model, readings, device);
  return position_covariance(misfit_rows(model, readings, scattered, {device}), intensity_unknown);
}

}  // namespace sim
