#pragma once
// A burst behind the resonator, cycle by cycle, and when it passes a level.
#include <complex>
#include <cstddef>
#include <vector>

#include "sim/fit/plan_text.hpp"
#include "sim/fit/rule_constants.hpp"

namespace sim {

using Phasor = std::complex<double>;

/// A step's light at the resonator.
struct StepResponse {
  double cycle_s;  // of the carrier
  Phasor steady;   // amplitude that is reached
  Phasor pole;     // 1/s: how what is left of the way to it falls
  Phasor step;     // what is left of it a cycle later
  double decay_s;  // time constant
  int settling;    // cycles until it is reached to half a per cent
};

/// Amplitude that the resonator is given, relative to the light of the plan's first step.
StepResponse response_of(const PlanStep& step, double amplitude, const RuleConstants& c);

/// One carrier cycle of a burst.
struct BurstCycle {
  double t, dt;          // when it begins, how long it is
  double before, after;  // amplitude behind the resonator
  double following;      // the level of the comparator that follows the peak
};

/// A burst until nothing changes any more, and what is left of it at its end. Most bursts of a step
/// begin with the same ringing and peak, so they have the same shape.
class BurstShape {
 public:
  /// The shape is the last one's where it begins alike.
  void play(const StepResponse& response, double on_s, const RuleConstants& c, Phasor ringing,
            double peak);

  void forget() { cycles_.clear(); }

  const std::vector<BurstCycle>& cycles() const { return cycles_; }
  /// Cycles of which the amplitude rises and is above the comparator that follows, as in those
  /// before them it is not. Behind them it is at least least_behind_rise(), and 0 is that where it
  /// passes the comparator once more.
  std::size_t rise_begin() const { return rise_begin_; }
  std::size_t rise_end() const { return rise_end_; }
  double least_behind_rise() const { return least_behind_rise_; }
  double greatest() const { return greatest_; }
  Phasor ringing() const { return ringing_; }
  /// Amplitude at the end over the comparator's level, gain at rest, and over the one that follows.
  double end_db() const { return end_db_; }
  double end_over_following_db() const { return end_over_following_db_; }
  double peak() const { return peak_; }

 private:
  std::vector<BurstCycle> cycles_;
  void take(const BurstCycle& cycle);

  std::size_t rise_begin_ = 0, rise_end_ = 0;
  double least_behind_rise_ = 0, greatest_ = 0;
  Phasor ringing_before_ = 0, ringing_ = 0;
  double peak_before_ = 0, peak_ = 0;
  double end_ = 0, end_db_ = 0, end_over_following_db_ = 0;
};

/// Which share of a cycle lies between a peak and where the wave passes a level below it: to 1e-5
/// (M. Abramowitz and I. Stegun, Handbook of Mathematical Functions, 4.4.45).
double share_above(double level, double peak);

/// When something passes its level on the way up, and down again.
struct LevelCrossing {
  double level;
  bool above = false;       // at the end of the cycles
  double from = 0, to = 0;  // s, from the burst's begin
  bool seen = false;        // above the level at any time

  void step(const BurstCycle& cycle);
};

/// `begin` is the cycle of the crossing before this one, of another burst: a guess of this one's.
LevelCrossing crossing_of(const BurstShape& shape, double level, std::size_t& begin);

}  // namespace sim
