#include "sim/proposal.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <utility>

namespace sim {
namespace {

/// Spots that are together less than this share of all are left to the noise as it comes.
constexpr double left_share = 1e-3;

/// Where so many spots are expected to fail by nature, noise is drawn as it comes.
constexpr double surely = 10;

/// Of the noise as it comes, where anything else is drawn.
constexpr double natural_share = 0.1;

/// With the tilt of just these levels: one of about them makes weights ten times as large.
dsp::TruncatedOrthant orthant_of(const Eigen::MatrixXd& cholesky, const Eigen::VectorXd& lower) {
  return {cholesky, lower, dsp::minimax_tilt(cholesky, lower).shift};
}

}  // namespace

Proposal::Proposal(std::vector<NoiseReading> readings, std::vector<WeakSpot> spots,
                   std::vector<std::vector<float>> coefficients)
    : coefficients_(std::move(coefficients)), readings_(std::move(readings)) {
  for (const WeakSpot& spot : spots) likelihood_ += spot.likelihood;
  if (likelihood_ > surely) return;
  const double least = left_share * likelihood_ / static_cast<double>(spots.size());
  double kept = 0;
  for (WeakSpot& spot : spots) {
    if (spot.likelihood <= least) continue;
    kept += spot.likelihood;
    const double likelihood = spot.likelihood;
    components_.push_back({std::move(spot), likelihood});
  }
  if (components_.empty()) return;
  natural_share_ = natural_share;
  for (Component& component : components_) component.share *= (1 - natural_share) / kept;
}

void Proposal::draw(TrialNoise& noise, const dsp::RandomAddress& draws) const {
  const WeakSpot* spot = chosen(draws.uniform(0));
  if (spot == nullptr) return;
  std::vector<double> uniforms;
  for (Eigen::Index i = 0; i < spot->lower.size(); ++i)
    uniforms.push_back(1 - draws.uniform(static_cast<std::uint32_t>(i) + 1));
  lift(*spot, noise, uniforms);
}

double Proposal::ratio(const TrialNoise& noise) const {
  double sum = natural_share_;
  for (const auto& [spot, share] : components_) {
    if (noise.value(readings_[spot.reading]) < spot.lower[0]) continue;
    const Eigen::VectorXd values = values_of(spot, noise);
    if ((values.array() < spot.lower.array()).any()) continue;
    const dsp::TruncatedOrthant lifted = orthant_of(cholesky_of(spot), spot.lower);
    sum += share * std::exp(lifted.log_ratio(values));
  }
  return sum;
}

/// Null: the noise as it comes.
const WeakSpot* Proposal::chosen(double uniform) const {
  double left = uniform - natural_share_;
  for (const auto& [spot, share] : components_) {
    if (left < 0) break;
    left -= share;
    if (left < 0) return &spot;
  }
  return nullptr;
}

/// Draws the spot's values anew, and the noise given them: what noise has besides these values does
/// not depend on them and stays.
void Proposal::lift(const WeakSpot& spot, TrialNoise& noise,
                    std::span<const double> uniforms) const {
  const Eigen::MatrixXd cholesky = cholesky_of(spot);
  const dsp::TruncatedOrthant lifted = orthant_of(cholesky, spot.lower);
  Eigen::VectorXd change = lifted.draw(uniforms) - values_of(spot, noise);
  const auto lower = cholesky.triangularView<Eigen::Lower>();
  lower.solveInPlace(change);
  lower.transpose().solveInPlace(change);
  for (Eigen::Index i = 0; i < change.size(); ++i)
    noise.add(readings_[spot.reading + static_cast<std::size_t>(i)], change[i]);
}

Eigen::MatrixXd Proposal::cholesky_of(const WeakSpot& spot) const {
  const Eigen::Index n = spot.lower.size();
  Eigen::MatrixXd covariances(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j <= i; ++j)
      covariances(i, j) = covariance(readings_[spot.reading + static_cast<std::size_t>(i)],
                                     readings_[spot.reading + static_cast<std::size_t>(j)]);
  return covariances.llt().matrixL();
}

Eigen::VectorXd Proposal::values_of(const WeakSpot& spot, const TrialNoise& noise) const {
  Eigen::VectorXd values(spot.lower.size());
  for (Eigen::Index i = 0; i < values.size(); ++i)
    values[i] = noise.value(readings_[spot.reading + static_cast<std::size_t>(i)]);
  return values;
}

}  // namespace sim
