#include "sim/importance_link.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "dsp/truncated_orthant.hpp"
#include "sim/link.hpp"
#include "sim/module_proposal.hpp"
#include "sim/peak_readings.hpp"

namespace sim {
namespace {

/// Likelihoods are worked out for multiples of these, in standard deviations, and interpolated.
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
  link->likelihoods = std::make_unique<LikelihoodTable>(covariances.llt().matrixL());
  return link;
}

}  // namespace

double LikelihoodTable::of(const Eigen::VectorXd& levels) {
  const auto n = static_cast<double>(levels.size());
  const double rise = n > 1 ? (levels[levels.size() - 1] - levels[0]) / (n - 1) : 0;
  const double level = levels.mean() / level_step, slope = rise / slope_step;
  const int row = static_cast<int>(std::floor(level)), column = static_cast<int>(std::floor(slope));
  const std::lock_guard lock(mutex_);
  const auto between_slopes = [&](int at) {
    return std::lerp(known(at, column), known(at, column + 1), slope - column);
  };
  const double log_p = std::lerp(between_slopes(row), between_slopes(row + 1), level - row);
  return std::exp(std::min(0.0, log_p));
}

double LikelihoodTable::known(int row, int column) {
  const auto [place, unknown] = known_.try_emplace({row, column});
  if (!unknown) return place->second;
  const Eigen::Index n = cholesky_.rows();
  const double half = 0.5 * static_cast<double>(n - 1);
  const Eigen::VectorXd places = Eigen::VectorXd::LinSpaced(n, -half, half);
  const Eigen::VectorXd line = (column * slope_step * places).array() + row * level_step;
  return place->second = dsp::minimax_tilt(cholesky_, line).log_probability;
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
