#include "sim/fit/fitted_module.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/counting/sample_quantile.hpp"
#include "sim/failure.hpp"
#include "sim/fit/rule_search.hpp"

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
    {centre, 6, "bursts of 30 cycles near Emin, on carriers 4 and 8 % off"},
    {q, 3.5, "bursts of 30 cycles near Emin, on carriers 4 and 8 % off"},
    {threshold, 2, "bursts of 30 cycles at levels 1 dB apart around Emin"},
    {integrator, 2.5, "bursts of 30 cycles at levels 1 dB apart around Emin"},
    {comparator_hold, 2.5, "a wire of the LED's drive beside the output"},
    {atc_fraction, 2.5, "short bursts that are weaker than the ones 3 to 30 ms before them"},
    {atc_release, 1.5, "short bursts that are weaker than the ones 3 to 30 ms before them"},
    {attack, 4.5, "carriers of 1.2 s at eight levels"},
    {duty, 4, "trains of long bursts that the output lets go of, at other duties"},
    {long_burst, 4, "trains of bursts between those lengths, too dense to be held"},
    {free_cycles, 2.5, "trains of bursts just longer than the limit, too dense to be held"},
    {min_gap, 4, "trains of short bursts with gaps of 8 to 40 cycles"},
    {dark_hold, 4, "short bursts behind a carrier, at gaps of 3 to 30 ms"},
    {margin, 4, "a carrier, then short bursts that are weaker by 0 to 20 dB"},
    {range, 12, "a carrier that is stronger: of one at least the output must not let go"},
}};

constexpr double normal_95 = 1.96;

double deviation_of(const RuleFit& fit, RuleParameter parameter) {
  return std::sqrt(fit.covariance(place_of(parameter), place_of(parameter)));
}

/// Where a number lies with 95 %.
struct Reach {
  double low, high;
};

Reach reach_of(const RuleFit& fit, const ConstantNote& note) {
  const std::size_t place = place_of(note.parameter);
  const double reach = normal_95 * note.widening * deviation_of(fit, note.parameter);
  return {std::min(fit.x[place] - reach, fit.low[place]),
          std::max(fit.x[place] + reach, fit.high[place])};
}

/// Told: where it may lie is a good deal less than where any part may.
bool is_told(const RuleFit& fit, const ParameterPriors& priors, const ConstantNote& note) {
  constexpr double most_left = 0.6;
  const ParameterPrior& prior = priors[place_of(note.parameter)];
  const Reach interval = reach_of(fit, note);
  const double length = interval.high - std::max(interval.low, prior.least);
  return length < 2 * normal_95 * most_left * prior.deviation;
}

FittedNumber number_of_part(const RuleFit& fit, const ParameterPriors& priors,
                            const ConstantNote& note) {
  const std::size_t place = place_of(note.parameter);
  const Reach interval = reach_of(fit, note);
  const auto value = [&](double x) { return value_of(note.parameter, x); };
  const bool told = is_told(fit, priors, note);
  return {.key = std::string(priors[place].key),
          .value = value(fit.x[place]),
          .low = value(interval.low),
          .high = value(interval.high),
          .is_told = told,
          .more = told ? "" : note.more};
}

/// Emin in mW/m2: the level of the comparator, and what resonator and hold make of it. The first
/// step's light is known no better than the other levels.
FittedNumber emin_number(const RuleFit& fit, const ConstantNote& note,
                         const channel::ModuleData& like, const FitSettings& settings, bool told) {
  const double first_level = settings.first_level_mw_per_m2;
  if (first_level == 0)
    return {.key = "emin_mw_per_m2",
            .value = like.emin_mw_per_m2,
            .low = like.emin_mw_per_m2,
            .high = like.emin_mw_per_m2,
            .is_told = false,
            .more = "the irradiance of the first step"};
  const auto emin = [&](const Numbers& x) {
    return module_of(x, like, first_level).emin_mw_per_m2;
  };
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
  const double reach =
      normal_95 * std::hypot(note.widening * std::sqrt(variance), settings.level_error);
  return {.key = "emin_mw_per_m2",
          .value = value,
          .low = value * std::exp(-reach),
          .high = value * std::exp(reach),
          .is_told = told,
          .more = told ? "" : note.more};
}

/// What like it has where the recording does not tell.
channel::ModuleData told_module(const RuleFit& fit, const ParameterPriors& priors,
                                const channel::ModuleData& like, double first_level) {
  Numbers x = fit.x;
  for (const ConstantNote& note : constant_notes)
    if (!is_told(fit, priors, note))
      x[place_of(note.parameter)] = priors[place_of(note.parameter)].middle;
  channel::ModuleData module = module_of(x, like, first_level);
  if (first_level == 0) module.emin_mw_per_m2 = like.emin_mw_per_m2;
  return module;
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

/// Kinds of steps that speak of one part of the rule.
enum class StepKind { carrier, release, long_train, short_train, single };

StepKind kind_of(const Plan& plan, std::size_t s, double long_burst_cycles) {
  const PlanStep& step = plan.steps[s];
  if (is_long_carrier(step)) return StepKind::carrier;
  constexpr double soon_ms = 20;
  if (s > 0 && is_long_carrier(plan.steps[s - 1]) &&
      step.start_ms - end_ms(plan.steps[s - 1]) < soon_ms)
    return StepKind::release;
  if (step.repeats > 1 && static_cast<double>(step.cycles_on) > long_burst_cycles)
    return StepKind::long_train;
  const double period = static_cast<double>(step.cycles_on + step.cycles_off) / step.carrier_hz;
  constexpr double dense_s = 8e-3;
  return step.repeats > 1 && period < dense_s ? StepKind::short_train : StepKind::single;
}

struct KindWords {
  StepKind kind;
  const char* light;
  const char* quantity;
  const char* unit;
};
constexpr std::array<KindWords, 5> kind_words{{
    {StepKind::carrier, "long carriers", "time until the output lets go", "ms"},
    {StepKind::release, "short bursts behind a carrier", "bursts reported", "1"},
    {StepKind::long_train, "trains of long bursts", "bursts reported", "1"},
    {StepKind::short_train, "trains of short bursts", "bursts reported", "1"},
    {StepKind::single, "short bursts at rest", "bursts reported", "1"},
}};

const KindWords& words_of(StepKind kind) {
  return *std::ranges::find(kind_words, kind, &KindWords::kind);
}

/// The number of bursts, or of a carrier the time, and the length of the pulses.
std::vector<FittedStep> fitted_steps(const PlanLikelihood& likelihood, const Numbers& x) {
  const auto compared = likelihood.compared(x);
  const Numbers deviations = likelihood.deviations(x);
  const double long_cycles = value_of(long_burst, x[place_of(long_burst)]);
  std::vector<FittedStep> steps;
  for (std::size_t s = 0; s < compared.size(); ++s) {
    const PlanStep& step = likelihood.plan().steps[s];
    const KindWords& words = words_of(kind_of(likelihood.plan(), s, long_cycles));
    const double on_ms = 1e3 * static_cast<double>(step.cycles_on) / step.carrier_hz;
    const double scale = words.kind == StepKind::carrier ? on_ms : 1;
    steps.push_back({.step = s,
                     .recorded = scale * compared[s].recorded.reported,
                     .fitted = scale * compared[s].ruled.reported,
                     .deviation = -deviations[s * n_feature_kinds],
                     .quantity = fmt::format("{}: {}", words.light, words.quantity),
                     .unit = words.unit});
    if (compared[s].recorded.with_low == 0 || compared[s].ruled.with_low == 0) continue;
    steps.push_back({.step = s,
                     .recorded = compared[s].recorded.low_s * step.carrier_hz,
                     .fitted = compared[s].ruled.low_s * step.carrier_hz,
                     .deviation = -deviations[s * n_feature_kinds + 1],
                     .quantity = fmt::format("{}: length of the output", words.light),
                     .unit = "cycle"});
  }
  return steps;
}

/// Steps of one quantity that no constants explain: more of them than chance and chaos have.
std::vector<FitMisfit> misfits_of(const std::vector<FittedStep>& steps) {
  constexpr double far = 4;
  std::vector<FitMisfit> misfits;
  std::vector<std::string> seen;
  for (const FittedStep& first : steps) {
    if (std::ranges::find(seen, first.quantity) != seen.end()) continue;
    seen.push_back(first.quantity);
    std::vector<double> all, off;
    for (const FittedStep& step : steps) {
      if (step.quantity != first.quantity) continue;
      all.push_back(step.deviation);
      if (std::abs(step.deviation) > far) off.push_back(step.recorded - step.fitted);
    }
    constexpr std::size_t least = 3, share_of = 7;
    if (off.size() < least || share_of * off.size() < all.size()) continue;
    misfits.push_back(
        {first.quantity,
         fmt::format("{:+.3g} {} beside the rule in {} of {} steps", sample_quantile(off, 0.5),
                     first.unit == "1" ? "bursts" : first.unit, off.size(), all.size())});
  }
  return misfits;
}

/// The root of the mean square; of some chaotic trains, which are far off by little, no more than a
/// few standard deviations count.
double usual_deviation_of(const std::vector<FittedStep>& steps) {
  constexpr double most = 3;
  double sum = 0;
  for (const FittedStep& step : steps) sum += std::pow(std::min(std::abs(step.deviation), most), 2);
  return steps.empty() ? 0 : std::sqrt(sum / static_cast<double>(steps.size()));
}

void refuse_long_plan(const Plan& plan) {
  constexpr double most_bursts = 1e6;
  double bursts = 0;
  for (const PlanStep& step : plan.steps) bursts += static_cast<double>(step.repeats);
  if (bursts <= most_bursts) return;
  throw bad_input(fmt::format("a plan of {:g} bursts", bursts),
                  fmt::format("a fit takes {:g} at most", most_bursts),
                  "leave out steps, or some of their repeats");
}

}  // namespace

FittedModule fit_module(const Plan& plan, const PinRecording& recording,
                        const channel::ModuleData& like, const FitSettings& settings) {
  refuse_long_plan(plan);
  const PlanAlignment alignment = align(plan, recording);
  const std::vector<BurstOutput> recorded = recorded_bursts(plan, recording, alignment);
  const double level_error_db = 20 * std::log10(1 + settings.level_error);
  const ParameterPriors priors = parameter_priors(like, plan.steps.front().carrier_hz);
  const RuleFit fit = search_rule(plan, recorded, priors, level_error_db);
  PlanLikelihood likelihood(plan, recorded, all_steps_of(plan), priors, level_error_db);
  likelihood.take_deviations_at(fit.x);
  const double first_level = settings.first_level_mw_per_m2;

  FittedModule fitted;
  fitted.module = told_module(fit, priors, like, first_level);
  for (const ConstantNote& note : constant_notes) {
    if (note.parameter == threshold)
      fitted.numbers.push_back(
          emin_number(fit, note, like, settings, first_level > 0 && is_told(fit, priors, note)));
    else
      fitted.numbers.push_back(number_of_part(fit, priors, note));
  }
  fitted.steps = fitted_steps(likelihood, fit.x);
  fitted.not_apart = pairs_not_apart(fit, priors);
  fitted.misfits = misfits_of(fitted.steps);
  fitted.first_level_mw_per_m2 = first_level;
  fitted.clock_error = alignment.clock_error + 1e-6 * fit.x[place_of(clock)];
  fitted.start_s = alignment.start_s + fit.x[place_of(start)] / fitted.module.centre_hz;
  fitted.usual_deviation = usual_deviation_of(fitted.steps);
  return fitted;
}

}  // namespace sim
