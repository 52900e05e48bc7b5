#pragma once
// From a recording to the most likely constants, in stages: short bursts at rest (threshold, tune)
// and long carriers (attack, range) with their levels, then all steps, from the best that a search
// of the rest finds, and from there beyond the jumps that hold it.
#include <vector>

#include "sim/fit/least_squares.hpp"
#include "sim/fit/plan_likelihood.hpp"

namespace sim {

struct RuleFit {
  Numbers x;
  Covariance covariance;
  /// Where each number may lie, all others as they are, without being told from `x`: of numbers
  /// with which the output jumps; of others `x` itself.
  Numbers low, high;
  /// Of a decibel, as a share: levels are wrong, each for itself, so carriers are not that far
  /// apart.
  double scale_error = 0;
};

RuleFit search_rule(const JoinedLight& light, const ParameterPriors& priors, double level_error_db);

}  // namespace sim
