#pragma once
// The proposal of importance sampling for one trial: a mixture of the noise as it comes and of
// noise that lifts some readings in a row above their levels, one component for each way in which
// noise makes a bit fail. Its density is known exactly, whatever the levels are: levels that are
// wrong cost efficiency and never bias. Defensive mixture: Owen & Zhou, "Safe and effective
// importance sampling", J. Am. Stat. Assoc. 95 (2000), 135-143.
#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "dsp/philox.hpp"
#include "dsp/truncated_orthant.hpp"
#include "sim/noise/trial_noise.hpp"

namespace sim {

/// Numbers read off the noise, and each one's level.
struct Readings {
  std::vector<NoiseReading> of{};
  std::vector<double> levels{};
  int row = 1;  // so many in a row make a spot
};

/// A row of readings, from `first` on, each at or above its level less `slack`.
struct WeakSpot {
  std::size_t first = 0;
  double slack = 0;
  double likelihood = 0;  // about the probability of it; its weight in the mixture
};

class Proposal {
 public:
  Proposal() = default;  // the noise as it comes and nothing else
  Proposal(Proposal&&) = default;
  Proposal& operator=(Proposal&&) = default;
  /// `coefficients`: what the readings refer to, unless it lives elsewhere.
  Proposal(Readings readings, const std::vector<WeakSpot>& spots,
           std::vector<std::vector<float>> coefficients = {});

  /// About how probable it is by nature that any of the spots fails; may exceed 1.
  double likelihood() const { return likelihood_; }

  /// Of the noise as it comes: no weight exceeds its inverse. 1: there is nothing else.
  double natural_share() const { return natural_share_; }

  /// Makes of natural noise one that is drawn from this.
  void draw(TrialNoise& noise, const dsp::RandomAddress& draws) const;

  /// Density of the noise in this over its natural one.
  double ratio(const TrialNoise& noise) const;

 private:
  struct Component {
    WeakSpot spot;
    double share;
  };

  double lowest_first(const WeakSpot& spot) const;
  Eigen::VectorXd lower_of(const WeakSpot& spot) const;
  Eigen::MatrixXd cholesky_of(const WeakSpot& spot) const;
  Eigen::VectorXd values_of(const WeakSpot& spot, const TrialNoise& noise) const;
  void lift(const WeakSpot& spot, TrialNoise& noise, std::span<const double> uniforms) const;
  const WeakSpot* chosen(double uniform) const;

  std::vector<std::vector<float>> coefficients_;
  Readings readings_;
  std::vector<Component> components_;
  double likelihood_ = 0;
  double natural_share_ = 1;
};

}  // namespace sim
