#pragma once
// What weighted trials count: of importance sampling, whose trials have the noise that makes them
// fail and a weight that says how much rarer such noise is by nature
// (sim/trial/importance_trial.hpp). Runs of a group depend on each other a little, since its trials
// share them; groups do not.
#include <span>

namespace sim {

/// Of what runs with weights counted: x is a run's weight times its count.
struct WeightedSum {
  double sum = 0, squares = 0, largest = 0;  // of x over runs
  double group_squares = 0;                  // over groups: of the sum of x in a group, squared

  WeightedSum& operator+=(const WeightedSum& o);
  bool operator==(const WeightedSum&) const = default;

  /// (sum x)^2 / sum x^2: as many equal runs would say as much.
  double effective_size() const;
  /// Of the sum, seen as an estimate, from so many groups; NaN where nothing is known of it.
  double coefficient_of_variation(double groups) const;
  /// Whether the estimate can be trusted: not where a few runs make it.
  bool is_sound() const;
};

/// Of the runs of one group.
WeightedSum weighted_sum(std::span<const double> x);

/// Nothing in it: trials were counted as they come.
struct Weighted {
  double n_groups = 0;
  WeightedSum bit_errors, frames_lost;
  double dark_likelihood = 0;  // sum over trials: that noise makes light of a dark bit

  Weighted& operator+=(const Weighted& o);
  bool operator==(const Weighted&) const = default;
};

}  // namespace sim
