#include "sim/fit/fitted_steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "sim/counting/sample_quantile.hpp"

namespace sim {
namespace {

/// Kinds of steps that speak of one part of the rule.
enum class StepKind { carrier, release, way_back, long_train, short_train, train_of_many, single };

StepKind kind_of(const Plan& plan, std::size_t s, double long_burst_cycles) {
  const PlanStep& step = plan.steps[s];
  if (is_long_carrier(step)) return StepKind::carrier;
  if (is_behind_carrier(plan, s)) {
    const bool is_next = is_long_carrier(plan.steps[s - 1]);
    return is_next && !is_train(step) ? StepKind::way_back : StepKind::release;
  }
  constexpr std::uint64_t many = 500;  // what grows a little with each burst shows
  if (is_train(step) && step.repeats > many) return StepKind::train_of_many;
  if (step.repeats > 1 && static_cast<double>(step.cycles_on) > long_burst_cycles)
    return StepKind::long_train;
  const double period = static_cast<double>(step.cycles_on + step.cycles_off) / step.carrier_hz;
  constexpr double dense_s = 8e-3;
  return step.repeats > 1 && period < dense_s ? StepKind::short_train : StepKind::single;
}

constexpr std::array<std::pair<StepKind, const char*>, 7> lights{{
    {StepKind::carrier, "long carriers"},
    {StepKind::release, "short bursts behind a carrier"},
    {StepKind::way_back, "seldom bursts behind a carrier"},
    {StepKind::long_train, "trains of long bursts"},
    {StepKind::short_train, "trains of short bursts"},
    {StepKind::train_of_many, "trains of many bursts"},
    {StepKind::single, "short bursts at rest"},
}};

const char* words_of(StepKind kind) {
  return std::ranges::find(lights, kind, &std::pair<StepKind, const char*>::first)->second;
}

/// What of a step says whether its bursts are reported.
struct ToldFeature {
  FeatureKind feature;
  double StepFeatures::*value;
  double scale;
  const char* words;
  const char* unit;
};

ToldFeature told_feature(const PlanStep& step) {
  using enum FeatureKind;
  if (is_long_carrier(step))
    return {reported, &StepFeatures::reported,
            1e3 * static_cast<double>(step.cycles_on) / step.carrier_hz,
            "time until the output lets go", "ms"};
  if (is_train(step))  // how many are reported behind the first ones is chaotic
    return {first_run, &StepFeatures::first_run, 1,
            "bursts before the first change, lost ones below 0", "1"};
  return {reported, &StepFeatures::reported, 100 / static_cast<double>(step.repeats),
          "bursts reported", "%"};
}

/// So many steps that are so far off are a misfit, where they are one of so many.
struct Misfitting {
  double deviations;
  std::size_t least, one_of;
};

/// First bursts need to be far off, as some trains are chaotic from the first change on; of the way
/// back a plan has few steps.
Misfitting misfitting(StepEvidence evidence) {
  switch (evidence) {
    case StepEvidence::first_bursts:
      return {.deviations = 8, .least = 3, .one_of = 12};
    case StepEvidence::way_back:
      return {.deviations = 4, .least = 2, .one_of = 3};
    default:
      return {.deviations = 4, .least = 3, .one_of = 7};
  }
}

StepEvidence evidence_of(StepKind kind, FeatureKind feature) {
  if (feature == FeatureKind::first_run) return StepEvidence::first_bursts;
  return kind == StepKind::way_back ? StepEvidence::way_back : StepEvidence::usual;
}

/// Where a train's first bursts are not reported, its light is about as strong as Emin, and noise
/// decides which one is.
bool is_off(const FittedStep& step, double deviations) {
  const bool is_dim =
      step.evidence == StepEvidence::first_bursts && std::min(step.recorded, step.fitted) <= 0;
  return !is_dim && std::abs(step.deviation) > deviations;
}

/// Of many numbers.
std::optional<FitMisfit> misfit_on_the_whole(const std::vector<FittedStep>& steps) {
  constexpr std::size_t many = 100;
  const double usual = usual_deviation_of(steps);
  if (steps.size() < many || usual <= most_usual_deviation) return std::nullopt;
  return FitMisfit{"all steps",
                   fmt::format("{:.2g} standard deviations beside the rule on the whole", usual)};
}

}  // namespace

std::vector<FittedStep> fitted_steps(const PlanLikelihood& likelihood, const Numbers& x) {
  const auto compared = likelihood.compared(x);
  const Numbers deviations = likelihood.deviations(x);
  const double long_cycles =
      value_of(RuleParameter::long_burst, x[place_of(RuleParameter::long_burst)]);
  std::vector<FittedStep> steps;
  for (std::size_t s = 0; s < compared.size(); ++s) {
    const StepKind kind = kind_of(likelihood.plan(), s, long_cycles);
    const JoinedStep& origin = likelihood.origin(s);
    const PlanStep& step = likelihood.plan().steps[s];
    const char* light = words_of(kind);
    const ToldFeature told = told_feature(step);
    const double level_db = likelihood.level_db(x, s);
    const auto deviation = [&](FeatureKind feature) {
      return -deviations[s * n_feature_kinds + static_cast<std::size_t>(feature)];
    };
    steps.push_back({.capture = origin.capture,
                     .step = origin.step,
                     .level_db = level_db,
                     .recorded = told.scale * compared[s].recorded.*told.value,
                     .fitted = told.scale * compared[s].ruled.*told.value,
                     .deviation = deviation(told.feature),
                     .quantity = fmt::format("{}: {}", light, told.words),
                     .unit = told.unit,
                     .evidence = evidence_of(kind, told.feature),
                     .carrier_hz = step.carrier_hz});
    if (compared[s].recorded.with_low == 0 || compared[s].ruled.with_low == 0) continue;
    steps.push_back({.capture = origin.capture,
                     .step = origin.step,
                     .level_db = level_db,
                     .recorded = compared[s].recorded.low_s * step.carrier_hz,
                     .fitted = compared[s].ruled.low_s * step.carrier_hz,
                     .deviation = deviation(FeatureKind::low),
                     .quantity = fmt::format("{}: length of the output", light),
                     .unit = "cycle",
                     .evidence = StepEvidence::usual,
                     .carrier_hz = step.carrier_hz});
  }
  return steps;
}

std::optional<OutputWidth> output_width(const PlanLikelihood& likelihood, const Numbers& x) {
  const auto compared = likelihood.compared(x);
  const Plan& plan = likelihood.plan();
  const double carrier_hz = plan.steps.front().carrier_hz;
  std::optional<OutputWidth> width;
  for (std::size_t s = 0; s < compared.size(); ++s) {
    const PlanStep& step = plan.steps[s];
    const StepFeatures& recorded = compared[s].recorded;
    const bool is_at_rest = is_burst_or_carrier(plan, s) && !is_long_carrier(step);
    if (!is_at_rest || recorded.with_low == 0 || step.carrier_hz != carrier_hz) continue;
    const double more = recorded.low_s * carrier_hz - static_cast<double>(step.cycles_on);
    if (!width) width = OutputWidth{more, more};
    width->least_cycles = std::min(width->least_cycles, more);
    width->most_cycles = std::max(width->most_cycles, more);
  }
  return width;
}

std::vector<FitMisfit> misfits_of(const std::vector<FittedStep>& steps) {
  std::vector<FitMisfit> misfits;
  std::vector<std::string> seen;
  for (const FittedStep& first : steps) {
    if (std::ranges::find(seen, first.quantity) != seen.end()) continue;
    seen.push_back(first.quantity);
    const Misfitting too_far = misfitting(first.evidence);
    std::vector<double> all, off;
    for (const FittedStep& step : steps) {
      if (step.quantity != first.quantity) continue;
      all.push_back(step.deviation);
      if (is_off(step, too_far.deviations)) off.push_back(step.recorded - step.fitted);
    }
    if (off.size() < too_far.least || too_far.one_of * off.size() < all.size()) continue;
    misfits.push_back(
        {first.quantity,
         fmt::format("{:+.3g} {} beside the rule in {} of {} steps", sample_quantile(off, 0.5),
                     first.unit == "1" ? "bursts" : first.unit, off.size(), all.size())});
  }
  if (const auto whole = misfit_on_the_whole(steps)) misfits.push_back(*whole);
  return misfits;
}

double usual_deviation_of(const std::vector<FittedStep>& steps) {
  constexpr double most = 3;
  double sum = 0;
  for (const FittedStep& step : steps) sum += std::pow(std::min(std::abs(step.deviation), most), 2);
  return steps.empty() ? 0 : std::sqrt(sum / static_cast<double>(steps.size()));
}

}  // namespace sim
