#include "sim/fit/plan_likelihood.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

namespace sim {
namespace {

/// Of a pulse's begin and of its length: a comparator sees a cycle's peak, or the next one's.
constexpr double cycles_uncertain = 0.3;
constexpr double uncertain_db = 0.25;  // of the signal: noise, and the rule in continuous time

std::span<const BurstOutput> bursts_of(const std::vector<BurstOutput>& all,
                                       const std::vector<std::size_t>& first, std::size_t step) {
  return {all.data() + first[step], first[step + 1] - first[step]};
}

/// Of a train: how many bursts the gain lets go of, or comes back for, once it has done so before.
double chaotic_bursts(const PlanStep& step, const StepFeatures& features) {
  if (!is_train(step)) return 0;
  const double run = features.first_run, left = static_cast<double>(step.repeats) - std::abs(run);
  return std::max(run > 0 ? features.reported - run : left - features.reported, 0.0);
}

}  // namespace

std::vector<std::size_t> all_steps_of(const Plan& plan) {
  std::vector<std::size_t> steps(plan.steps.size());
  std::iota(steps.begin(), steps.end(), std::size_t{0});
  return steps;
}

PlanLikelihood::PlanLikelihood(const JoinedLight& light, const std::vector<std::size_t>& steps,
                               const ParameterPriors& priors, double level_error_db)
    : captures_(light.captures), priors_(priors.begin(), priors.end()) {
  const std::vector<std::size_t> first = first_bursts(light.plan);
  for (const std::size_t s : steps) {
    plan_.steps.push_back(light.plan.steps[s]);
    origin_.push_back(light.steps[s]);
    const auto bursts = bursts_of(light.recorded, first, s);
    recorded_.insert(recorded_.end(), bursts.begin(), bursts.end());
  }
  first_ = first_bursts(plan_);
  for (std::size_t k = 1; k < captures_.size(); ++k) {
    priors_.push_back(priors[place_of(RuleParameter::start)]);
    priors_.push_back(priors[place_of(RuleParameter::clock)]);
    priors_.push_back(captures_[k].level);
  }
  first_level_ = priors_.size();
  for (std::size_t s = 0; s < light.plan.steps.size(); ++s)
    add_level({captures_[light.steps[s].capture].levels_of, light.plan.steps[s].level_db},
              level_error_db);
  for (std::size_t s = 0; s < plan_.steps.size(); ++s)
    level_of_step_.push_back(
        place_of_level({captures_[origin_[s].capture].levels_of, plan_.steps[s].level_db}));
  for (std::size_t s = 0; s < plan_.steps.size(); ++s) {
    const auto bursts = bursts_of(recorded_, first_, s);
    heard_.push_back(features_of(plan_.steps[s], bursts));
    take_means(plan_.steps[s], bursts, bursts, heard_.back());
  }
  compared_.resize(plan_.steps.size());
}

std::size_t PlanLikelihood::place_of_level(const PlanLevel& level) const {
  const auto found = std::ranges::find_if(levels_, [&](const PlanLevel& other) {
    return other.levels_of == level.levels_of && std::abs(other.db - level.db) < 0.005;
  });
  return first_level_ + static_cast<std::size_t>(found - levels_.begin());
}

void PlanLikelihood::add_level(const PlanLevel& level, double level_error_db) {
  if (place_of_level(level) < priors_.size()) return;
  levels_.push_back(level);
  priors_.push_back({"", 0, level_error_db, 0.1, true});
}

/// Which cycle's peak it is, is the same in all steps whose pulses are alike: they tell it once.
double PlanLikelihood::alike(std::size_t step, FeatureKind kind) const {
  constexpr double alike_cycles = 0.25;
  const double carrier = plan_.steps[step].carrier_hz;
  const auto value = [&](std::size_t s) {
    const double on = static_cast<double>(plan_.steps[s].cycles_on);
    return kind == FeatureKind::low ? heard_[s].low_s * carrier - on : heard_[s].start_s * carrier;
  };
  double number = 0;
  for (std::size_t s = 0; s < heard_.size(); ++s)
    if (std::abs(plan_.steps[s].carrier_hz - carrier) < 1e-3 * carrier &&
        std::abs(value(s) - value(step)) < alike_cycles)
      ++number;
  return number;
}

Numbers PlanLikelihood::start() const {
  Numbers x(priors_.size());
  for (std::size_t i = 0; i < priors_.size(); ++i) x[i] = priors_[i].middle;
  return x;
}

double PlanLikelihood::level_db(const Numbers& x, std::size_t step) const {
  const std::size_t capture = origin_[step].capture;
  const double light_db = capture == 0 ? 0 : x[place_of(CaptureNumber::level, capture)];
  return light_db + plan_.steps[step].level_db;
}

std::vector<double> PlanLikelihood::amplitudes(const Numbers& x) const {
  std::vector<double> all;
  for (std::size_t s = 0; s < plan_.steps.size(); ++s) {
    const double error_db = x[level_of_step_[s]];
    all.push_back(std::pow(10, (level_db(x, s) + error_db) / 20));
  }
  return all;
}

void PlanLikelihood::play(const Played& played,
                          const std::function<bool(std::size_t)>& look) const {
  RuleConstants constants = constants_of(played.x);
  constants.hold_s += played.more_hold_cycles / constants.centre_hz;
  std::vector<double> light = amplitudes(played.x);
  for (double& one : light) one *= std::pow(10, played.more_db / 20);
  rule_.play(plan_, constants, light, [&](std::size_t s, bool is_new) {
    if (is_new) compared_[s] = compared_bursts(s);
    return look(s);
  });
}

PlanLikelihood::Compared PlanLikelihood::compared_bursts(std::size_t s) const {
  const PlanStep& step = plan_.steps[s];
  const auto recorded = bursts_of(recorded_, first_, s);
  const std::vector<BurstOutput>& ruled = rule_.bursts(s);
  Compared compared{heard_[s], features_of(step, ruled)};
  take_means(step, recorded, ruled, compared.recorded);
  take_means(step, ruled, recorded, compared.ruled);
  return compared;
}

PlanLikelihood::Compared PlanLikelihood::compared_step(const Numbers& x, std::size_t s) const {
  const PlanStep& step = plan_.steps[s];
  Compared compared = compared_[s];
  const double cycle_s = 1 / value_of(RuleParameter::centre, x[place_of(RuleParameter::centre)]);
  const std::size_t capture = origin_[s].capture;
  compared.ruled.start_s +=
      start_cycles(x, capture) * cycle_s + x[place_of(CaptureNumber::clock, capture)] * 1e-6 *
                                               (step.start_ms - captures_[capture].begin_ms) * 1e-3;
  return compared;
}

std::array<double, n_feature_kinds> PlanLikelihood::differences(const Compared& compared,
                                                                std::size_t step) const {
  const auto& [was, is] = compared;
  const double carrier = plan_.steps[step].carrier_hz;
  const bool both_low = was.with_low > 0 && is.with_low > 0;
  const bool both_start = was.with_start > 0 && is.with_start > 0;
  return {is.reported - was.reported, both_low ? (is.low_s - was.low_s) * carrier : 0,
          both_start ? (is.start_s - was.start_s) * carrier : 0, is.first_run - was.first_run};
}

std::vector<double> PlanLikelihood::differences(const Played& played) const {
  std::vector<double> all;
  all.reserve(plan_.steps.size() * n_feature_kinds);
  play(played, [&](std::size_t s) {
    const auto of_step = differences(compared_step(played.x, s), s);
    all.insert(all.end(), of_step.begin(), of_step.end());
    return true;
  });
  return all;
}

void PlanLikelihood::take_wide_deviations() {
  constexpr double low_cycles = 1, start_cycles = 2, share = 0.05, carrier_s = 1e-3;
  constexpr double share_chaotic = 0.15;
  sigma_.clear();
  for (std::size_t s = 0; s < plan_.steps.size(); ++s) {
    const PlanStep& step = plan_.steps[s];
    const double on_s = static_cast<double>(step.cycles_on) / step.carrier_hz;
    const double reported = heard_[s].reported, run = std::abs(heard_[s].first_run);
    const double chaotic = chaotic_bursts(step, heard_[s]);
    sigma_.push_back(is_long_carrier(step)
                         ? carrier_s / on_s + share * reported
                         : 1 + share * std::max(reported, 20.0) + share_chaotic * chaotic);
    // The gain may let go of a long burst before its end.
    const double may_be_cut = is_train(step) ? static_cast<double>(step.cycles_on) : 0;
    sigma_.push_back(low_cycles + share * may_be_cut);
    sigma_.push_back(start_cycles);
    sigma_.push_back(1 + share * run);
  }
}

/// By how much a train's first bursts last longer where the gain is a little higher before them
/// than the rule has it; those that follow forget it.
double PlanLikelihood::uncertain_cut(const Numbers& x, std::size_t step,
                                     const Compared& compared) const {
  constexpr double gain_db = 0.1, whole = 0.97;
  const PlanStep& burst = plan_.steps[step];
  const double shorter_s = std::min(compared.recorded.low_s, compared.ruled.low_s);
  const bool is_cut = shorter_s * burst.carrier_hz < whole * static_cast<double>(burst.cycles_on);
  if (!is_train(burst) || !is_cut) return 0;
  const double attack_db_per_s =
      1e3 * value_of(RuleParameter::attack, x[place_of(RuleParameter::attack)]);
  return gain_db / attack_db_per_s * burst.carrier_hz / std::max(compared.ruled.with_low, 1);
}

void PlanLikelihood::take_deviations_at(const Numbers& x) {
  const std::vector<Compared> here = compared(x);
  const std::vector<double> longer = differences({x, cycles_uncertain, 0});
  const std::vector<double> shorter = differences({x, -cycles_uncertain, 0});
  const std::vector<double> stronger = differences({x, 0, uncertain_db});
  const std::vector<double> weaker = differences({x, 0, -uncertain_db});
  sigma_.clear();
  for (std::size_t i = 0; i < longer.size(); ++i) {
    const PlanStep& step = plan_.steps[i / n_feature_kinds];
    const auto kind = static_cast<FeatureKind>(i % n_feature_kinds);
    const double on_s = static_cast<double>(step.cycles_on) / step.carrier_hz;
    const bool is_time = kind == FeatureKind::low || kind == FeatureKind::start;
    constexpr double carrier_s = 0.2e-3, bursts = 0.4, share_chaotic = 0.05;
    const double chaotic = kind == FeatureKind::reported
                               ? share_chaotic * chaotic_bursts(step, heard_[i / n_feature_kinds])
                               : 0;
    const double least = is_time ? cycles_uncertain * std::sqrt(alike(i / n_feature_kinds, kind))
                         : is_long_carrier(step) ? carrier_s / on_s
                                                 : bursts + chaotic;
    const double cut = kind == FeatureKind::low
                           ? uncertain_cut(x, i / n_feature_kinds, here[i / n_feature_kinds])
                           : 0;
    sigma_.push_back(std::hypot(std::hypot(least, cut), (longer[i] - shorter[i]) / 2,
                                (stronger[i] - weaker[i]) / 2));
  }
}

void PlanLikelihood::visit_deviations(const Numbers& x,
                                      const std::function<bool(double)>& take) const {
  play({x}, [&](std::size_t s) {
    const auto of_step = differences(compared_step(x, s), s);
    for (std::size_t kind = 0; kind < n_feature_kinds; ++kind)
      if (!take(of_step[kind] / sigma_[s * n_feature_kinds + kind])) return false;
    return true;
  });
}

Numbers PlanLikelihood::deviations(const Numbers& x) const {
  Numbers all;
  all.reserve(sigma_.size());
  visit_deviations(x, [&](double deviation) {
    all.push_back(deviation);
    return true;
  });
  return all;
}

std::vector<PlanLikelihood::Compared> PlanLikelihood::compared(const Numbers& x) const {
  std::vector<Compared> all;
  play({x}, [&](std::size_t s) {
    all.push_back(compared_step(x, s));
    return true;
  });
  return all;
}

}  // namespace sim
