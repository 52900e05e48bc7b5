#include "sim/fit/joined_light.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
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

/// Steps of a capture, each with its bursts, at the end of all.
void append(const LightCapture& capture, const std::vector<BurstOutput>& recorded, bool is_repeated,
            JoinedLight& all) {
  const std::size_t place = all.captures.size() - 1;
  const double begin_ms = all.captures.back().begin_ms;
  const std::vector<std::size_t> first = first_bursts(capture.plan);
  for (std::size_t s = 0; s < capture.plan.steps.size(); ++s) {
    if (is_repeated && !is_burst_or_carrier(capture.plan, s)) continue;
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
    const auto same = std::ranges::find(captures, capture.plan, &LightCapture::plan);
    const double begin_ms = all.plan.steps.empty() ? 0 : end_ms(all.plan.steps.back()) + rest_ms;
    const auto levels_of = static_cast<std::size_t>(same - captures.begin());
    const bool is_repeated = levels_of < all.captures.size() || capture.ambient_w_per_m2 > 0;
    all.captures.push_back(
        {begin_ms, alignment, levels_of, level_prior(capture, captures.front(), level_error_db)});
    append(capture, recorded, is_repeated, all);
  }
  return all;
}

}  // namespace sim
