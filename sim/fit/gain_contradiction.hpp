#pragma once
// Whether trains contradict all else that a plan shows. One rule says how the gain falls and comes
// back in all steps, so long carriers, the bursts behind them and those at rest must have the same
// constants alone as together with trains. Where the search did not find the best ones, those of a
// part that follows the rule may seem to differ too, but explain little more.
#include <optional>

#include "sim/fit/fit_result.hpp"
#include "sim/fit/plan_likelihood.hpp"

namespace sim {

/// What carriers and bursts say alone, where that explains them by much more than `x` does, the
/// most likely numbers of all steps. Nothing of a plan without long carriers or without trains, as
/// there is nothing to contradict. Deviations are those that `likelihood` took last.
std::optional<FitMisfit> contradiction_of_trains(PlanLikelihood& likelihood, const Numbers& x);

}  // namespace sim
