#pragma once
// Which light measures a module's constants, part by part; each part is a list of trials, and of
// them so many are taken as fit into the time.
//
//   mark  five bursts at the strongest level: where the plan begins, and what its levels refer to
//   Emin  bursts of 30 cycles at levels around Emin: Emin, width of the output, integrator
//   tune  the same on carriers 5 and 10 % off: centre and Q of the band-pass
//   A     1.2 s of carrier at eight levels, 8 dB apart: how fast the gain falls; behind the strong
//         ones short bursts 16 dB weaker: how far it has fallen; then at levels between
//   B     carrier, then short bursts 0 to 20 dB weaker: how fast the gain comes back; behind some
//         only seldom ones, 22 to 42 dB weaker: how it comes back from afar
//   C     trains of bursts, at lengths and gaps in steps: which duty is held, of which bursts
//   D     dense trains of five lengths by five gaps: which bursts are short, which gaps end one;
//         from the second pass on
#include <cstdint>

#include "channel/emitter.hpp"
#include "channel/receiver_module.hpp"
#include "sim/fit/bench_light.hpp"

namespace sim {

inline constexpr double least_minutes = 1, most_minutes = 30;

/// So far above Emin the strongest level shall be: as far as the weakest of A's is below it.
inline constexpr double strongest_above_emin_db = 54;

/// A schedule for a module like this one, of at most so many minutes (1 to 30). Throws
/// Failure(bad_input) for a module whose carrier the sketch cannot make.
BenchSchedule schedule_for(const channel::ModuleData& like, const channel::EmitterData& led,
                           double minutes);

/// Throws Failure(bad_input) for a part that exists in theory only.
void refuse_no_module(const channel::ModuleData& like);

/// How far from the LED the module is to be, in metres.
double bench_distance_m(const channel::ModuleData& like, const channel::EmitterData& led);

/// What the strongest level, the plan's first, comes to there, in mW/m2.
double bench_first_level(const channel::ModuleData& like);

}  // namespace sim
