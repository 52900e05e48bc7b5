#include "sim/link/importance_link.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "dsp/truncated_orthant.hpp"
#include "sim/link/link.hpp"
#include "sim/noise/peak_readings.hpp"

namespace sim {
namespace {

/// Likelihoods are worked out for multiples of these, in standard deviations, and interpolated.
constexpr double level_step = 0.25, slope_step = 0.1;
/// Levels and slopes beyond these count as these: below is sure, above next to impossible.
constexpr double lowest_level = -10, highest_level = 30, steepest = 10;
constexpr std::size_t n_levels =
    static_cast<std::size_t>((highest_level - lowest_level) / level_step) + 2;
constexpr std::size_t n_slopes = 2 * static_cast<std::size_t>(steepest / slope_step) + 2;

/// Covariance of so many peaks in a row.
Eigen::MatrixXd peak_covariance(const Link& link, int n) {
  const PeakReadings peaks(link.chain.module, link.chain.carrier, 0);
  Eigen::MatrixXd all(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) all(i, j) = covariance(peaks.reading(i), peaks.reading(j));
  return all;
}

std::shared_ptr<ImportanceLink> with_readings(const Eigen::MatrixXd& covariances) {
  auto link = std::make_shared<ImportanceLink>();
  link->readings = static_cast<int>(covariances.rows());
  link->likelihoods = std::make_unique<const LikelihoodTable>(covariances.llt().matrixL());
  return link;
}

}  // namespace

LikelihoodTable::LikelihoodTable(Eigen::MatrixXd cholesky)
    : cholesky_(std::move(cholesky)), known_(n_levels * n_slopes) {
  for (std::atomic<double>& log_p : known_) log_p = std::numeric_limits<double>::quiet_NaN();
}

double LikelihoodTable::of(double level, double rise) const {
  const double y = (std::clamp(level, lowest_level, highest_level) - lowest_level) / level_step;
  const double x = (std::clamp(rise, -steepest, steepest) + steepest) / slope_step;
  const int row = static_cast<int>(y), column = static_cast<int>(x);
  const auto between_slopes = [&](int at) {
    return std::lerp(known(at, column), known(at, column + 1), x - column);
  };
  const double log_p = std::lerp(between_slopes(row), between_slopes(row + 1), y - row);
  return std::exp(std::min(0.0, log_p));
}

double LikelihoodTable::known(int row, int column) const {
  std::atomic<double>& place =
      known_[static_cast<std::size_t>(row) * n_slopes + static_cast<std::size_t>(column)];
  double log_p = place.load(std::memory_order_relaxed);
  if (!std::isnan(log_p)) return log_p;
  log_p = worked_out(row, column);
  place.store(log_p, std::memory_order_relaxed);
  return log_p;
}

double LikelihoodTable::worked_out(int row, int column) const {
  const double level = lowest_level + row * level_step, rise = column * slope_step - steepest;
  const Eigen::Index n = cholesky_.rows();
  const double half = 0.5 * static_cast<double>(n - 1);
  const Eigen::VectorXd places = Eigen::VectorXd::LinSpaced(n, -half, half);
  return dsp::minimax_tilt(cholesky_, (rise * places).array() + level).log_probability;
}

int missed_cycles(const channel::ModuleData& module, dsp::Hertz carrier, bool population) {
  const double centre_hz = module.centre_hz * (population ? 1 + module.centre_tolerance : 1);
  const double cycles =
      (module.comparator_hold_cycles + module.integrator_cycles) * carrier.value / centre_hz;
  return std::max(1, static_cast<int>(std::ceil(cycles)) - 1);
}

std::shared_ptr<const ImportanceLink> make_importance_link(const Link& link) {
  const int n = missed_cycles(link.module, carrier_of(link), link.population);
  return with_readings(peak_covariance(link, n));
}

std::shared_ptr<const ImportanceLink> make_importance_link(
    const channel::CorrelatorOutput& output) {
  auto importance = with_readings(Eigen::MatrixXd::Identity(1, 1));
  importance->output = output;
  return importance;
}

}  // namespace sim
