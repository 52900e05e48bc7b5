#include "sim/fit/fitted_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace sim {
namespace {

using enum RuleParameter;

/// What is said of a constant beside its number.
struct ConstantNote {
  RuleParameter parameter;
  /// By how much intervals of the curvature are too narrow, measured on hidden parts
  /// (tests/hidden_parts): rounding to carrier cycles and the rule's own errors are alike in many
  /// steps.
  double widening;
  const char* more;  // which light would tell it
};

constexpr std::array<ConstantNote, 15> constant_notes{{
    {centre, 3, "bursts of 30 cycles near Emin, on carriers 4 and 8 % off"},
    {q, 3.2, "bursts of 30 cycles near Emin, on carriers 4 and 8 % off"},
    {threshold, 2, "bursts of 30 cycles at levels 1 dB apart around Emin"},
    {integrator, 2.5, "bursts of 30 cycles at levels 1 dB apart around Emin"},
    {comparator_hold, 2.5, "a wire of the LED's drive beside the output"},
    {atc_fraction, 2.2, "short bursts that are weaker than the ones 3 to 30 ms before them"},
    {atc_release, 1.5, "short bursts that are weaker than the ones 3 to 30 ms before them"},
    {attack, 4.5, "carriers of 1.2 s at eight levels"},
    {duty, 4, "trains of long bursts that the output lets go of, at other duties"},
    {long_burst, 3.5, "trains of bursts between those lengths, too dense to be held"},
    {free_cycles, 2.5, "trains of bursts just longer than the limit, too dense to be held"},
    {min_gap, 2.5, "trains of short bursts with gaps of 8 to 40 cycles"},
    {dark_hold, 4, "short bursts behind a carrier, at gaps of 3 to 30 ms"},
    {margin, 6, "a carrier, then short bursts that are weaker by 0 to 20 dB"},
    {range, 0,
     "a carrier that is stronger: of one at least the output must not let go. Record the plan once "
     "more at an eighth of the distance, or nearer"},
}};

constexpr double normal_95 = 1.96;

double deviation_of(const RuleFit& fit, RuleParameter parameter) {
  return std::sqrt(fit.covariance(place_of(parameter), place_of(parameter)));
}

/// What the scale of decibels adds to that: attack and range are as long as it is. The range hangs
/// on fewer levels than the scale does; by how much more is measured on hidden parts.
double scale_deviation(const RuleFit& fit, RuleParameter parameter) {
  constexpr double of_few_levels = 1.5;
  if (parameter == attack) return fit.scale_error;
  return parameter == range ? of_few_levels * fit.scale_error * fit.x[place_of(range)] : 0;
}

/// Where a number lies with 95 %.
struct Reach {
  double low, high;
};

Reach reach_of(const RuleFit& fit, const ConstantNote& note) {
  const std::size_t place = place_of(note.parameter);
  const double reach = normal_95 * std::hypot(note.widening * deviation_of(fit, note.parameter),
                                              scale_deviation(fit, note.parameter));
  if (note.parameter == range) return {fit.low[place] - reach, fit.high[place] + reach};
  return {std::min(fit.x[place] - reach, fit.low[place]),
          std::max(fit.x[place] + reach, fit.high[place])};
}

constexpr double most_range_db = 139;  // more is as good as no limit

/// Told: where it may lie is a good deal less than where any part may.
bool is_told(const RuleFit& fit, const ParameterPriors& priors, const ConstantNote& note) {
  constexpr double most_left = 0.6;
  const ParameterPrior& prior = priors[place_of(note.parameter)];
  const Reach interval = reach_of(fit, note);
  if (note.parameter == range) return interval.high < most_range_db;
  const double length = interval.high - std::max(interval.low, prior.least);
  return length < 2 * normal_95 * most_left * prior.deviation;
}

/// Of what is not told: where any part may have it, less what the recording shuts out.
Reach usual_reach(const RuleFit& fit, const ParameterPrior& prior, const ConstantNote& note) {
  const Reach reach = reach_of(fit, note);
  const double x = fit.x[place_of(note.parameter)], usual = normal_95 * prior.deviation;
  return {std::min(std::max(reach.low, prior.middle - usual), x),
          std::max(std::min(reach.high, prior.middle + usual), x)};
}

/// A hold of two or three carrier cycles is none: of any a part's file makes another rule.
double held_or_none(RuleParameter parameter, double value) {
  constexpr double none_ms = 0.05;
  return parameter == dark_hold && value < none_ms ? 0 : value;
}

bool is_of_gain_control(RuleParameter parameter) {
  return parameter >= attack && parameter <= range;
}

const ConstantNote& note_on(RuleParameter parameter) {
  return *std::ranges::find(constant_notes, parameter, &ConstantNote::parameter);
}

/// Not where the output let go of nothing: that shuts out a few gain controls, and tells of none.
bool tells_gain_control(const RuleFit& fit, const ParameterPriors& priors) {
  return is_told(fit, priors, note_on(attack)) || is_told(fit, priors, note_on(duty));
}

FittedNumber number_of_part(const RuleFit& fit, const ParameterPriors& priors,
                            const ConstantNote& note) {
  const std::size_t place = place_of(note.parameter);
  const auto value = [&](double x) {
    return held_or_none(note.parameter, value_of(note.parameter, x));
  };
  const bool told = is_told(fit, priors, note) &&
                    (!is_of_gain_control(note.parameter) || tells_gain_control(fit, priors));
  const Reach interval = told ? reach_of(fit, note) : usual_reach(fit, priors[place], note);
  return {.key = std::string(priors[place].key),
          .value = value(fit.x[place]),
          .low = value(interval.low),
          .high = value(interval.high),
          .is_told = told,
          .more = told ? "" : note.more};
}

/// Relative variance of Emin: of the comparator's level, and of what resonator and hold make of it.
double emin_variance(const RuleFit& fit, const channel::ModuleData& like) {
  const auto emin = [&](const Numbers& x) { return module_of(x, like, 1).emin_mw_per_m2; };
  const double value = emin(fit.x);
  const std::array parameters{threshold, q, comparator_hold};
  std::array<double, parameters.size()> slopes{};
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    constexpr double step = 1e-3;
    Numbers moved = fit.x;
    moved[place_of(parameters[i])] += step;
    slopes[i] = std::log(emin(moved) / value) / step;
  }
  double variance = 0;
  for (std::size_t i = 0; i < parameters.size(); ++i)
    for (std::size_t k = 0; k < parameters.size(); ++k)
      variance +=
          slopes[i] * slopes[k] * fit.covariance(place_of(parameters[i]), place_of(parameters[k]));
  return variance;
}

constexpr const char* emin_key = "emin_mw_per_m2";

/// Emin in mW/m2. The first step's light is known no better than the other levels.
FittedNumber emin_number(const RuleFit& fit, const ParameterPriors& priors,
                         const ConstantNote& note, const FittedLight& light) {
  const double known = light.like.emin_mw_per_m2;
  if (!light.first_level_mw_per_m2)
    return {.key = emin_key,
            .value = known,
            .low = known,
            .high = known,
            .is_told = false,
            .more = "the irradiance of the first step"};
  const double value = module_of(fit.x, light.like, *light.first_level_mw_per_m2).emin_mw_per_m2;
  const bool told = is_told(fit, priors, note);
  const double reach =
      normal_95 *
      std::hypot(note.widening * std::sqrt(emin_variance(fit, light.like)), light.level_error);
  return {.key = emin_key,
          .value = value,
          .low = value * std::exp(-reach),
          .high = value * std::exp(reach),
          .is_told = told,
          .more = told ? "" : note.more};
}

/// By how much a lamp made the light of a capture seem weaker, dB.
struct LampEffect {
  double ambient_w_per_m2;
  double weaker_db, deviation_db;
};

/// Of the first capture under a lamp; nothing where there is none.
std::optional<LampEffect> lamp_effect(const RuleFit& fit, const FittedLight& light) {
  constexpr double widening = 2, unmoved_db = 0.05;
  for (std::size_t k = 1; k < light.captures.size(); ++k) {
    const CaptureLight& capture = light.captures[k];
    if (capture.ambient_w_per_m2 == 0) continue;
    const std::size_t place = place_of(CaptureNumber::level, k);
    const double known_db = capture.level_db ? 20 * std::log10(1 + light.level_error) : unmoved_db;
    return LampEffect{capture.ambient_w_per_m2, capture.level_db.value_or(0) - fit.x[place],
                      std::hypot(widening * std::sqrt(fit.covariance(place, place)), known_db)};
  }
  return std::nullopt;
}

/// How Emin grows in ambient light: Emin^2 + k E (1 + E / Es), as channel/receiver_module.hpp has
/// it. Es is that of the module like it.
FittedNumber ambient_number(const RuleFit& fit, const FittedLight& light,
                            const FittedNumber& emin) {
  FittedNumber number{.key = "ambient_k",
                      .value = light.like.ambient_k,
                      .low = light.like.ambient_k,
                      .high = light.like.ambient_k,
                      .is_told = false,
                      .more = "the same light once more, under a lamp: --ambient"};
  const std::optional<LampEffect> effect = lamp_effect(fit, light);
  if (!effect || !emin.is_told) return number;
  const double e = effect->ambient_w_per_m2;
  const double known = e * (1 + e / light.like.ambient_es_w_per_m2);
  const auto k_of = [&](double emin_mw_per_m2, double weaker_db) {
    const double raised = emin_mw_per_m2 * emin_mw_per_m2 * (std::pow(10, weaker_db / 10) - 1);
    return std::max(raised / known, 0.0);
  };
  const double reach_db = normal_95 * effect->deviation_db;
  number.value = k_of(emin.value, effect->weaker_db);
  number.low = k_of(emin.low, effect->weaker_db - reach_db);
  number.high = k_of(emin.high, effect->weaker_db + reach_db);
  constexpr double longest = 0.1;  // parts have 0 to 0.12
  number.is_told = number.high - number.low < longest;
  number.more = number.is_told ? "" : "a lamp that is stronger, on the same light";
  return number;
}

}  // namespace

std::vector<FittedNumber> fitted_numbers(const RuleFit& fit, const ParameterPriors& priors,
                                         const FittedLight& light) {
  std::vector<FittedNumber> numbers;
  for (const ConstantNote& note : constant_notes)
    numbers.push_back(note.parameter == threshold ? emin_number(fit, priors, note, light)
                                                  : number_of_part(fit, priors, note));
  numbers.push_back(
      ambient_number(fit, light, *std::ranges::find(numbers, emin_key, &FittedNumber::key)));
  return numbers;
}

bool is_threshold_told(const RuleFit& fit, const ParameterPriors& priors) {
  return is_told(fit, priors, note_on(threshold));
}

std::vector<std::string> pairs_not_apart(const RuleFit& fit, const ParameterPriors& priors) {
  constexpr double together = 0.97;
  std::vector<std::string> sentences;
  for (std::size_t i = 0; i < constant_notes.size(); ++i)
    for (std::size_t k = i + 1; k < constant_notes.size(); ++k) {
      const RuleParameter one = constant_notes[i].parameter, other = constant_notes[k].parameter;
      const double correlation = fit.covariance(place_of(one), place_of(other)) /
                                 (deviation_of(fit, one) * deviation_of(fit, other));
      if (std::abs(correlation) < together) continue;
      sentences.push_back(fmt::format(
          "{} and {} are told together only: what would part them is {}", priors[place_of(one)].key,
          priors[place_of(other)].key, constant_notes[k].more));
    }
  return sentences;
}

}  // namespace sim
