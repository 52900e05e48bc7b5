#pragma once
// What a logic analyser records of hidden parts' outputs while a plan's light is on them: the
// chain's own stages (channel/), with a carrier and a level a step.
#include <cstdint>
#include <span>
#include <vector>

#include "hidden_part.hpp"
#include "sim/fit/pin_recording.hpp"
#include "sim/fit/plan_text.hpp"

namespace hidden {

/// Parts that are played to at once.
inline constexpr int most_parts = 8;

/// Of the analyser, 1 MS/s.
inline constexpr double analyser_step_s = 1e-6;

/// 600 kS/s, or the whole multiple of it that has four samples in each carrier cycle.
double sample_rate_of(const sim::Plan& plan);

/// When the plan is over, dark included.
double end_s(const sim::Plan& plan);

/// What is simulated around the plan.
struct DarkAround {
  std::int64_t before = 0, behind = 0;  // samples
};

/// The samples at whose end each part's pin changes, from high at first, counted from the first
/// sample of the dark before the plan. At most eight parts, all of them with the plan's clock.
std::vector<std::vector<std::int64_t>> edges_of(const sim::Plan& plan,
                                                std::span<const HiddenPart> parts,
                                                double first_level_mw_per_m2, DarkAround around);

/// The same as each part's analyser records it. At most eight parts.
std::vector<sim::PinRecording> recordings_of(const sim::Plan& plan,
                                             std::span<const HiddenPart> parts,
                                             double first_level_mw_per_m2);

}  // namespace hidden
