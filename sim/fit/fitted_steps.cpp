#include "sim/fit/fitted_steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/counting/sample_quantile.hpp"

namespace sim {
namespace {

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

}  // namespace

std::vector<FittedStep> fitted_steps(const PlanLikelihood& likelihood, const Numbers& x) {
  const auto compared = likelihood.compared(x);
  const Numbers deviations = likelihood.deviations(x);
  const double long_cycles =
      value_of(RuleParameter::long_burst, x[place_of(RuleParameter::long_burst)]);
  std::vector<FittedStep> steps;
  for (std::size_t s = 0; s < compared.size(); ++s) {
    const JoinedStep& origin = likelihood.origin(s);
    const PlanStep& step = likelihood.plan().steps[s];
    const KindWords& words = words_of(kind_of(likelihood.plan(), s, long_cycles));
    const double on_ms = 1e3 * static_cast<double>(step.cycles_on) / step.carrier_hz;
    const double scale = words.kind == StepKind::carrier ? on_ms : 1;
    const double level_db = likelihood.level_db(x, s);
    steps.push_back({.capture = origin.capture,
                     .step = origin.step,
                     .level_db = level_db,
                     .recorded = scale * compared[s].recorded.reported,
                     .fitted = scale * compared[s].ruled.reported,
                     .deviation = -deviations[s * n_feature_kinds],
                     .quantity = fmt::format("{}: {}", words.light, words.quantity),
                     .unit = words.unit});
    if (compared[s].recorded.with_low == 0 || compared[s].ruled.with_low == 0) continue;
    steps.push_back({.capture = origin.capture,
                     .step = origin.step,
                     .level_db = level_db,
                     .recorded = compared[s].recorded.low_s * step.carrier_hz,
                     .fitted = compared[s].ruled.low_s * step.carrier_hz,
                     .deviation = -deviations[s * n_feature_kinds + 1],
                     .quantity = fmt::format("{}: length of the output", words.light),
                     .unit = "cycle"});
  }
  return steps;
}

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

double usual_deviation_of(const std::vector<FittedStep>& steps) {
  constexpr double most = 3;
  double sum = 0;
  for (const FittedStep& step : steps) sum += std::pow(std::min(std::abs(step.deviation), most), 2);
  return steps.empty() ? 0 : std::sqrt(sum / static_cast<double>(steps.size()));
}

}  // namespace sim
