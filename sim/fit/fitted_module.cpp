#include "sim/fit/fitted_module.hpp"

#include <algorithm>
#include <cmath>

#include "sim/fit/fitted_numbers.hpp"
#include "sim/fit/fitted_steps.hpp"
#include "sim/fit/gain_contradiction.hpp"
#include "sim/fit/rule_search.hpp"

namespace sim {
namespace {

FittedLight light_of(const std::vector<LightCapture>& captures, const channel::ModuleData& like) {
  const std::optional<double> first = captures.front().first_level_mw_per_m2;
  FittedLight light{like, first, level_error, {}};
  for (const LightCapture& capture : captures) {
    const std::optional<double> own = capture.first_level_mw_per_m2;
    const std::optional<double> level_db =
        first && own ? std::optional(20 * std::log10(*own / *first)) : std::nullopt;
    light.captures.push_back({level_db, capture.ambient_w_per_m2});
  }
  return light;
}

std::vector<FittedCapture> fitted_captures(const RuleFit& fit, const JoinedLight& light) {
  std::vector<FittedCapture> captures;
  const double cycle_s = 1 / constants_of(fit.x).centre_hz;
  for (std::size_t k = 0; k < light.captures.size(); ++k) {
    const PlanAlignment& alignment = light.captures[k].alignment;
    captures.push_back(
        {.start_s = alignment.start_s + start_cycles(fit.x, k) * cycle_s,
         .clock_error = alignment.clock_error + 1e-6 * fit.x[place_of(CaptureNumber::clock, k)],
         .level_db = k == 0 ? 0 : fit.x[place_of(CaptureNumber::level, k)],
         .fitted_steps = light.captures[k].steps,
         .is_cut_short = light.captures[k].is_cut_short});
  }
  return captures;
}

/// Of all steps but those under a lamp.
double strongest_db(const std::vector<FittedStep>& steps,
                    const std::vector<LightCapture>& captures) {
  double strongest = -HUGE_VAL;
  for (const FittedStep& step : steps)
    if (captures[step.capture].ambient_w_per_m2 == 0)
      strongest = std::max(strongest, step.level_db);
  return strongest;
}

}  // namespace

FittedModule fit_module(const std::vector<LightCapture>& captures,
                        const channel::ModuleData& like) {
  const double level_error_db = 20 * std::log10(1 + level_error);
  const JoinedLight joined = join(captures, level_error_db);
  const ParameterPriors priors = parameter_priors(like, joined.plan.steps.front().carrier_hz);
  const RuleFit fit = search_rule(joined, priors, level_error_db);
  PlanLikelihood likelihood(joined, all_steps_of(joined.plan), priors, level_error_db);
  likelihood.take_deviations_at(fit.x);
  const FittedLight light = light_of(captures, like);

  FittedModule fitted;
  fitted.numbers = fitted_numbers(fit, priors, light);
  fitted.steps = fitted_steps(likelihood, fit.x);
  fitted.not_apart = pairs_not_apart(fit, priors);
  fitted.misfits = misfits_of(fitted.steps);
  if (const auto contradiction = contradiction_of_trains(likelihood, fit.x))
    fitted.misfits.push_back(*contradiction);
  fitted.captures = fitted_captures(fit, joined);
  fitted.strongest_db = strongest_db(fitted.steps, captures);
  if (is_threshold_told(fit, priors))
    fitted.strongest_over_emin_db =
        fitted.strongest_db - 20 * std::log10(module_of(fit.x, like, 1).emin_mw_per_m2);
  fitted.output_width = output_width(likelihood, fit.x);
  fitted.usual_deviation = usual_deviation_of(fitted.steps);
  return fitted;
}

}  // namespace sim
