#pragma once
// The constants of the rule as a fit sees them: numbers without bounds, each with a prior of where
// parts lie of which nothing is known, and a step by which to look for what it changes.
#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <vector>

#include "channel/receiver_module.hpp"
#include "sim/fit/output_rule.hpp"

namespace sim {

/// What a fit moves: constants first, in the order below, then others.
using Numbers = std::vector<double>;

enum class RuleParameter : std::size_t {
  centre,
  q,
  threshold,
  integrator,
  comparator_hold,
  atc_fraction,
  atc_release,
  attack,
  duty,
  long_burst,
  free_cycles,
  min_gap,
  dark_hold,
  margin,
  range,
  start,
  clock,
  count
};

inline constexpr std::size_t n_rule_parameters = static_cast<std::size_t>(RuleParameter::count);

constexpr std::size_t place_of(RuleParameter p) { return static_cast<std::size_t>(p); }

/// Numbers of a capture: of the first one start and clock above, of each other one three behind
/// those of the rule. Only the others have a level: dB over the first one's light.
enum class CaptureNumber : std::size_t { start, clock, level, count };

inline std::size_t place_of(CaptureNumber number, std::size_t capture) {
  const auto place = static_cast<std::size_t>(number);
  if (capture == 0) return place_of(RuleParameter::start) + place;
  return n_rule_parameters + (capture - 1) * static_cast<std::size_t>(CaptureNumber::count) + place;
}

struct ParameterPrior {
  std::string_view key;  // of a part file; empty: of the recording
  double middle = 0, deviation = 1;
  double step = 0.01;        // of differences
  bool is_smooth = false;    // nothing jumps with it: one side is enough
  double least = -HUGE_VAL;  // below it nothing changes
};

using ParameterPriors = std::array<ParameterPrior, n_rule_parameters>;

/// Of a part like this one, wide enough for any other; `carrier_hz` is the plan's.
ParameterPriors parameter_priors(const channel::ModuleData& like, double carrier_hz);

/// The part that has these constants, `like` it in all that the rule does not know. The light of
/// the plan's first step has `first_level`.
channel::ModuleData module_of(const Numbers& x, const channel::ModuleData& like,
                              double first_level_mw_per_m2);

/// What the numbers say. `x` has n_rule_parameters numbers at least.
RuleConstants constants_of(const Numbers& x);

/// Carrier cycles from the start of a capture's alignment to where its plan begins. Edges tell
/// where the integrator is full, so the number `start` is that: what the integrator has does not
/// move it.
double start_cycles(const Numbers& x, std::size_t capture);

/// The value of a part file; of the threshold it is the comparator's level, relative to the light
/// of the plan's first step.
double value_of(RuleParameter parameter, double x);

}  // namespace sim
