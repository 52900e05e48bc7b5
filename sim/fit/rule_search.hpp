#pragma once
// From a recording to the most likely constants, in stages: short bursts at rest (threshold, tune),
// long carriers (attack, range), then all steps, from the best of a grid of what the rule may be.
#include <vector>

#include "sim/fit/least_squares.hpp"
#include "sim/fit/plan_likelihood.hpp"

namespace sim {

struct RuleFit {
  Numbers x;
  Covariance covariance;
  double cost = 0;
};

RuleFit search_rule(const Plan& plan, const std::vector<BurstOutput>& recorded,
                    const ParameterPriors& priors, double level_error_db);

}  // namespace sim
