#include "sim/fit/joined_light.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <span>

#include "sim/failure.hpp"

namespace sim {
namespace {

constexpr double rest_ms = 1e6;  // 0.05 dB/ms and 1 % of duty give back 500 dB

void refuse_many_bursts(const std::vector<LightCapture>& captures) {
  constexpr double most_bursts = 1e6;
  double bursts = 0;
  for (const LightCapture& capture : captures)
    for (const PlanStep& step : capture.plan.steps) bursts += static_cast<double>(step.repeats);
  if (bursts <= most_bursts) return;
  throw bad_input(fmt::format("a plan of {:g} bursts", bursts),
                  fmt::format("a fit takes {:g} at most", most_bursts),
                  "leave out steps, or some of their repeats");
}

/// A lamp makes light seem weaker than it is.
ParameterPrior level_prior(const LightCapture& capture, const LightCapture& first,
                           double level_error_db) {
  constexpr double moved_db = 15, under_a_lamp_db = -3, of_any_lamp_db = 6, step_db = 0.1;
  ParameterPrior prior{"", 0, moved_db, step_db, true};
  if (capture.first_level_mw_per_m2 && first.first_level_mw_per_m2) {
    prior.middle = 20 * std::log10(*capture.first_level_mw_per_m2 / *first.first_level_mw_per_m2);
    prior.deviation = level_error_db;
  }
  if (capture.ambient_w_per_m2 > 0) {
    prior.middle += under_a_lamp_db;
    prior.deviation = of_any_lamp_db;
  }
  return prior;
}

/// Of a plan that tells nothing new the steps up to the first train that does not follow a long
/// carrier, once there was one. Steps cannot be left out between others: what the gain has lost in
/// them is not back yet.
std::size_t first_steps(const Plan& plan) {
  bool had_carrier = false;
  for (std::size_t s = 0; s < plan.steps.size(); ++s) {
    if (had_carrier && !is_burst_or_carrier(plan, s) && !is_behind_carrier(plan, s)) return s;
    had_carrier = had_carrier || is_long_carrier(plan.steps[s]);
  }
  return plan.steps.size();
}

/// Steps that a recording covers. One that ends with its last edge may have been silent behind it,
/// for as long as weak steps last; one that ends sooner was cut short.
std::size_t covered_steps(const LightCapture& capture, const PlanAlignment& alignment) {
  constexpr double weak_s = 10;
  const std::vector<PlanStep>& steps = capture.plan.steps;
  const auto recorded_end_s = [&](const PlanStep& step) {
    return alignment.recorded_s(end_ms(step) * 1e-3);
  };
  const double end_s = capture.recording.end_s;
  if (recorded_end_s(steps.back()) <= end_s + weak_s) return steps.size();
  const auto cut = std::ranges::find_if(
      steps, [&](const PlanStep& step) { return recorded_end_s(step) > end_s; });
  return std::max<std::size_t>(1, static_cast<std::size_t>(cut - steps.begin()));
}

/// Levels from the weakest to the strongest.
double level_span_db(const Plan& plan) {
  const auto [weakest, strongest] =
      std::ranges::minmax_element(plan.steps, {}, &PlanStep::level_db);
  return strongest->level_db - weakest->level_db;
}

/// The wire of the LED has each burst for as long as its light, however weak that is. What a module
/// makes of weak and of strong light differs by cycles.
void refuse_wire_of_light(const LightCapture& capture, const std::vector<BurstOutput>& recorded) {
  constexpr double least_span_db = 20, alike_cycles = 0.3, clock = 1e-4, most_others = 0.01;
  if (level_span_db(capture.plan) < least_span_db) return;
  double bursts = 0, others = 0;
  auto burst = recorded.begin();
  for (const PlanStep& step : capture.plan.steps) {
    const double on_s = static_cast<double>(step.cycles_on) / step.carrier_hz;
    const double alike_s =
        alike_cycles / step.carrier_hz + clock * on_s + capture.recording.resolution_s;
    for (std::uint64_t i = 0; i < step.repeats; ++i, ++bursts, ++burst)
      if (std::abs(burst->low_s - on_s) > alike_s) ++others;
  }
  if (others > most_others * bursts) return;
  throw bad_input("the recording has every burst as long as its light, however weak",
                  "it is the wire of the LED, or another copy of the light",
                  "say --wire, the module's output");
}

/// Steps of a capture, each with its bursts, at the end of all.
void append_steps(const LightCapture& capture, std::size_t steps,
                  const std::vector<BurstOutput>& recorded, JoinedLight& all) {
  const std::size_t place = all.captures.size() - 1;
  const double begin_ms = all.captures.back().begin_ms;
  const std::vector<std::size_t> first = first_bursts(capture.plan);
  for (std::size_t s = 0; s < steps; ++s) {
    PlanStep step = capture.plan.steps[s];
    step.start_ms += begin_ms;
    all.plan.steps.push_back(step);
    all.steps.push_back({place, s});
    const auto bursts = std::span(recorded).subspan(first[s], first[s + 1] - first[s]);
    all.recorded.insert(all.recorded.end(), bursts.begin(), bursts.end());
  }
}

}  // namespace

JoinedLight join(const std::vector<LightCapture>& captures, double level_error_db) {
  refuse_many_bursts(captures);
  JoinedLight all;
  for (const LightCapture& capture : captures) {
    const PlanAlignment alignment = align(capture.plan, capture.recording);
    const std::vector<BurstOutput> recorded =
        recorded_bursts(capture.plan, capture.recording, alignment);
    refuse_wire_of_light(capture, recorded);
    const auto same = std::ranges::find(captures, capture.plan, &LightCapture::plan);
    const double begin_ms = all.plan.steps.empty() ? 0 : end_ms(all.plan.steps.back()) + rest_ms;
    const auto levels_of = static_cast<std::size_t>(same - captures.begin());
    const bool is_repeated = levels_of < all.captures.size() || capture.ambient_w_per_m2 > 0;
    const std::size_t told = is_repeated ? first_steps(capture.plan) : capture.plan.steps.size();
    const std::size_t covered = covered_steps(capture, alignment);
    all.captures.push_back({begin_ms, alignment, levels_of,
                            level_prior(capture, captures.front(), level_error_db),
                            std::min(told, covered), covered < told});
    append_steps(capture, all.captures.back().steps, recorded, all);
  }
  return all;
}

JoinedLight cut_trains(const JoinedLight& light, std::uint64_t most) {
  const std::vector<std::size_t> first = first_bursts(light.plan);
  JoinedLight shorter = light;
  shorter.recorded.clear();
  for (std::size_t s = 0; s < light.steps.size(); ++s) {
    PlanStep& step = shorter.plan.steps[s];
    step.repeats = std::min(step.repeats, most);
    const auto begin = light.recorded.begin() + static_cast<std::ptrdiff_t>(first[s]);
    shorter.recorded.insert(shorter.recorded.end(), begin,
                            begin + static_cast<std::ptrdiff_t>(step.repeats));
  }
  return shorter;
}

double scale_error(const JoinedLight& light, double level_error_db) {
  std::set<double> levels;  // of one capture, as those of others are as wrong, or further levels
  for (std::size_t s = 0; s < light.plan.steps.size(); ++s)
    if (light.steps[s].capture == 0 && is_long_carrier(light.plan.steps[s]))
      levels.insert(light.plan.steps[s].level_db);
  double sum = 0, squares = 0;
  for (const double level : levels) sum += level, squares += level * level;
  const double n = static_cast<double>(levels.size());
  const double spread = levels.empty() ? 0 : squares - sum * sum / n;
  return spread > 0 ? level_error_db / std::sqrt(spread) : 0;
}

}  // namespace sim
