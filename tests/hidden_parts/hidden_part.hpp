#pragma once
// A hidden part: a receiver module of which nobody is told the numbers, on a bench whose levels and
// clock are a little wrong. What a fit says of its recording can be compared with what it is.
// Shares no code with the fit.
#include <array>
#include <cstdint>
#include <map>
#include <span>

#include "channel/receiver_module.hpp"
#include "sim/fit/plan_text.hpp"

namespace hidden {

/// In what a part's slow AGC breaks the rule of channel/slow_agc.hpp.
enum class Broken {
  nothing,
  steep_attack,          // attack doubles once the gain has fallen by 20 dB
  two_releases,          // release is 3 times as fast in its first 10 ms
  charged_short_bursts,  // gain falls for short bursts too, a fifth as fast
  harsh_long_bursts,     // beyond 300 cycles half the duty is tolerated
  linear_attack          // gain falls linearly in amplitude, by 20 dB in the same time
};

struct HiddenPart {
  channel::ModuleData module;
  std::map<long, double> level_factor;  // by level_key(): irradiance over what the plan says
  double clock_error = 0;  // a second of the plan is 1 + clock_error of the recording's
  double start_s = 0.5;    // of the plan, in the recording's time
  double tail_s = 0.5;     // recorded behind the plan's end
  std::array<std::uint32_t, 4> noise_seed{1, 2, 3, 4};
  double ambient_w_per_m2 = 0;  // of a lamp on it
  Broken broken = Broken::nothing;
};

/// Levels are the same if they are in hundredths of a dB.
long level_key(double level_db);

/// Irradiance of a level over what the plan says; 1 where the part has no error of it.
double level_factor(const HiddenPart& part, double level_db);

/// How parts are drawn.
struct PartDraw {
  std::uint64_t seed = 1;
  double nominal_hz = 56e3;
  double centre_share = 0.03;       // largest error of the centre
  double level_share = 0.1;         // largest error of a level
  double clock_share = 0.01;        // largest error of the clock
  Broken broken = Broken::nothing;  // of all parts; changes no other number
};

/// Of the frequencies that modules are made for the one nearest to a plan's first carrier.
double nominal_of(const sim::Plan& plan);

/// Part number `which` of a draw: the same whatever others are drawn. Only the errors of its levels
/// depend on the plan.
HiddenPart draw_part(const PartDraw& draw, std::uint32_t which, const sim::Plan& plan);

/// A number of a part file.
struct ModuleNumber {
  const char* key;
  double channel::ModuleData::*member;
};
std::span<const ModuleNumber> module_numbers();

}  // namespace hidden
