#pragma once
// What a recording has of a plan's steps beside what the fitted rule has, and where these differ by
// more than chance.
#include <optional>
#include <vector>

#include "sim/fit/fit_result.hpp"
#include "sim/fit/plan_likelihood.hpp"

namespace sim {

/// More is not usual of parts that follow the rule (README.md says of how many).
inline constexpr double most_usual_deviation = 0.8;

/// The number of bursts, of a train those in a row from its first on, of a carrier the time; and
/// the length of the pulses.
std::vector<FittedStep> fitted_steps(const PlanLikelihood& likelihood, const Numbers& x);

/// Of the carrier that the plan begins with.
std::optional<OutputWidth> output_width(const PlanLikelihood& likelihood, const Numbers& x);

/// Steps of one quantity that no constants explain: more of them than chance and chaos have. Behind
/// these all steps, where they are off on the whole.
std::vector<FitMisfit> misfits_of(const std::vector<FittedStep>& steps);

/// The root of the mean square; of some chaotic trains, which are far off by little, no more than a
/// few standard deviations count.
double usual_deviation_of(const std::vector<FittedStep>& steps);

}  // namespace sim
