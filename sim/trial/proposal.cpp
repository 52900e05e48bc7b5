#include "sim/trial/proposal.hpp"

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
constexpr double defensive_share = 0.1;

/// With the tilt of just these levels: with that of levels rounded to a grid the largest weights
/// were ten times as large.
dsp::TruncatedOrthant orthant_of(const Eigen::MatrixXd& cholesky, const Eigen::VectorXd& lower) {
  return {cholesky, lower, dsp::minimax_tilt(cholesky, lower).shift};
}

}  // namespace

Proposal::Proposal(Readings readings, const std::vector<WeakSpot>& spots,
                   std::vector<std::vector<float>> coefficients)
    : coefficients_(std::move(coefficients)), readings_(std::move(readings)) {
  for (const WeakSpot& spot : spots) likelihood_ += spot.likelihood;
  if (likelihood_ > surely) return;
  const double least = left_share * likelihood_ / static_cast<double>(spots.size());
  double kept = 0;
  for (const WeakSpot& spot : spots) {
    if (spot.likelihood <= least) continue;
    kept += spot.likelihood;
    components_.push_back({spot, spot.likelihood});
  }
  if (components_.empty()) return;
  natural_share_ = defensive_share;
  for (Component& component : components_) component.share *= (1 - defensive_share) / kept;
}

void Proposal::draw(TrialNoise& noise, const dsp::RandomAddress& draws) const {
  const WeakSpot* spot = chosen(draws.uniform(0));
  if (spot == nullptr) return;
  std::vector<double> uniforms;
  for (int i = 0; i < readings_.row; ++i)
    uniforms.push_back(1 - draws.uniform(static_cast<std::uint32_t>(i) + 1));
  lift(*spot, noise, uniforms);
}

double Proposal::ratio(const TrialNoise& noise) const {
  double sum = natural_share_;
  const WeakSpot* before = nullptr;
  double first = 0;  // the value of a spot's first reading, which most do not get past
  for (const auto& [spot, share] : components_) {
    if (before == nullptr || before->first != spot.first)
      first = noise.value(readings_.of[spot.first]);
    before = &spot;
    if (first < lowest_first(spot)) continue;
    const Eigen::VectorXd values = values_of(spot, noise), lower = lower_of(spot);
    if ((values.array() < lower.array()).any()) continue;
    sum += share * std::exp(orthant_of(cholesky_of(spot), lower).log_ratio(values));
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
  const dsp::TruncatedOrthant lifted = orthant_of(cholesky, lower_of(spot));
  Eigen::VectorXd change = lifted.draw(uniforms) - values_of(spot, noise);
  const auto lower = cholesky.triangularView<Eigen::Lower>();
  lower.solveInPlace(change);
  lower.transpose().solveInPlace(change);
  for (Eigen::Index i = 0; i < change.size(); ++i)
    noise.add(readings_.of[spot.first + static_cast<std::size_t>(i)], change[i]);
}

double Proposal::lowest_first(const WeakSpot& spot) const {
  return readings_.levels[spot.first] - spot.slack;
}

Eigen::VectorXd Proposal::lower_of(const WeakSpot& spot) const {
  const Eigen::Map<const Eigen::VectorXd> levels(readings_.levels.data() + spot.first,
                                                 readings_.row);
  return levels.array() - spot.slack;
}

Eigen::MatrixXd Proposal::cholesky_of(const WeakSpot& spot) const {
  const NoiseReading* const reading = readings_.of.data() + spot.first;
  Eigen::MatrixXd covariances(readings_.row, readings_.row);
  for (int i = 0; i < readings_.row; ++i)
    for (int j = 0; j <= i; ++j) covariances(i, j) = covariance(reading[i], reading[j]);
  return covariances.llt().matrixL();
}

Eigen::VectorXd Proposal::values_of(const WeakSpot& spot, const TrialNoise& noise) const {
  const NoiseReading* const reading = readings_.of.data() + spot.first;
  Eigen::VectorXd values(readings_.row);
  for (int i = 0; i < readings_.row; ++i) values[i] = noise.value(reading[i]);
  return values;
}

}  // namespace sim
