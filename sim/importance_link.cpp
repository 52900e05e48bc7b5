#include "sim/importance_link.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "sim/link.hpp"
#include "sim/module_proposal.hpp"
#include "sim/peak_readings.hpp"

namespace sim {
namespace {

/// Tilts are worked out for levels rounded to these, in standard deviations: any tilt is as right,
/// and near ones are as good.
constexpr double level_step = 0.25, slope_step = 0.1;

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
  link->tilts = std::make_unique<TiltTable>(covariances.llt().matrixL());
  return link;
}

}  // namespace

const dsp::OrthantTilt& TiltTable::of(const Eigen::VectorXd& levels) {
  const auto n = static_cast<int>(levels.size());
  const double rise = n > 1 ? (levels[n - 1] - levels[0]) / (n - 1) : 0;
  const std::pair key(static_cast<int>(std::lround(levels.mean() / level_step)),
                      static_cast<int>(std::lround(rise / slope_step)));
  const std::lock_guard lock(mutex_);
  const auto known = tilts_.find(key);
  if (known != tilts_.end()) return known->second;
  const Eigen::VectorXd places = Eigen::VectorXd::LinSpaced(n, -0.5 * (n - 1), 0.5 * (n - 1));
  const Eigen::VectorXd line = (key.second * slope_step * places).array() + key.first * level_step;
  return tilts_.emplace(key, dsp::minimax_tilt(cholesky_, line)).first->second;
}

double likelihood(const dsp::OrthantTilt& tilt) {
  return std::exp(std::min(0.0, tilt.log_probability));
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
