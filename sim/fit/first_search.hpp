#pragma once
// Where a search begins: the numbers that short bursts at rest (threshold, tune) and long carriers
// (attack, range) tell without the other steps, and how strong each capture's light is.
#include <vector>

#include "sim/fit/least_squares.hpp"
#include "sim/fit/plan_likelihood.hpp"

namespace sim {

/// The deviations of a likelihood, with the numbers that may move.
LeastSquaresProblem problem_of(PlanLikelihood& likelihood, std::vector<bool> is_free);

/// Numbers of which each level in turn takes the best of those that a bench may have: bursts near
/// Emin are all reported, or none, so a difference does not see that another level would do.
Numbers best_of_each_level(const LeastSquaresProblem& problem, Numbers x, std::size_t first_level);

/// All numbers; those that these steps do not tell are the priors'.
Numbers first_numbers(const JoinedLight& light, const ParameterPriors& priors,
                      double level_error_db);

}  // namespace sim
