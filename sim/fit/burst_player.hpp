#pragma once
// A module that is shown one burst after the other, and what its output makes of each: resonator,
// comparator that follows the peak, integrator and slow AGC, each by its own equations. It is the
// rule of channel/slow_agc.hpp and channel/demodulator.hpp in continuous time, from one event to
// the next.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "sim/fit/burst_shape.hpp"
#include "sim/fit/gain_state.hpp"
#include "sim/fit/rule_constants.hpp"

namespace sim {

/// One burst at the output.
struct BurstOutput {
  double low_s = 0;     // how long the pin is low for it
  double start_s = 0;   // from the burst's begin to the falling edge, where there is one
  bool begins = false;  // with a falling edge; not where it goes on from the burst before
  double share = 0;     // 1: reported, 0: not; between where half a cycle decides
};

/// From when to when something is above its level; none: they are equal.
struct LightSpell {
  double from = 0, to = 0;
  double length() const { return to - from; }
};

/// Counts up in light and down in dark; the output follows at the stops.
class PulseIntegrator {
 public:
  explicit PulseIntegrator(double top_s) : top_(top_s) {}

  struct Pulse {
    double start = 0, over = 0;  // `over`: by how much the top was, or would have been, passed
    bool begins = false;
  };

  /// Light in a spell, and dark since the last one's end. Times are absolute.
  Pulse spell(const LightSpell& light) {
    dark_until(light.from);
    Pulse pulse;
    const double reach = light.from + (top_ - level_);
    pulse.over = light.to - reach;
    if (!low_ && pulse.over >= 0) {
      low_ = true;
      pulse.begins = true;
      pulse.start = reach;
    }
    level_ = std::min(level_ + light.length(), top_);
    now_ = light.to;
    return pulse;
  }

  bool low() const { return low_; }
  double level_s() const { return level_; }

  /// Whether what follows from a moment in the dark is the same for both.
  bool goes_on_as(const PulseIntegrator& other, double from) const {
    PulseIntegrator one = *this, another = other;
    one.dark_until(from);
    another.dark_until(from);
    return one.low_ == another.low_ && is_nearly(one.level_, another.level_);
  }
  void skip(double s) { now_ += s; }

  /// The end of the pulse under way, if no light comes.
  double end_of_pulse() const { return now_ + level_; }

 private:
  void dark_until(double to) {
    const double dark = to - now_;
    if (dark >= level_) low_ = false;
    level_ = std::max(level_ - dark, 0.0);
    now_ = to;
  }

  double top_;
  double level_ = 0, now_ = -1e9;
  bool low_ = false;
};

/// What a part remembers at the end of a burst. Times are absolute.
struct PartMemory {
  explicit PartMemory(const RuleConstants& c) : gain(c), integrator(c.integrator_s) {}

  GainState gain;
  PulseIntegrator integrator;
  Phasor ringing = 0;
  double now = -1e9;
  double active_until = -1e9;
  double peak = 0;  // that the comparator follows
};

/// Bursts one after the other.
class BurstPlayer {
 public:
  explicit BurstPlayer(const RuleConstants& c)
      : c_(c), memory_(c), margin_(gain_of(-c.margin_db)) {}

  const PartMemory& memory() const { return memory_; }
  void remember(const PartMemory& memory) { memory_ = memory; }

  /// Whether a burst that begins then is the same behind both.
  bool goes_on_as(const PartMemory& other, const StepResponse& response, double start_s) const;

  /// Bursts that follow are of this step.
  void begin_step(const StepResponse& response, double on_s, double off_s);

  BurstOutput burst(double start_s);

  /// What the next burst depends on, at the end of one.
  std::array<double, 7> state() const;

  /// As if bursts had gone on for so long that change nothing.
  void skip(double s);

 private:
  /// What is left behind dark.
  struct Rest {
    Phasor ringing;
    double peak;
  };
  Rest rest_of(double dark_s, const StepResponse& response) const;

  void rest_until(double start_s);

  /// The whole burst: which spells of it the comparator and the AGC see.
  void rise();

  /// A burst that lasts until the gain has come back so far that it is activity.
  void notice(LevelCrossing& activity) const;

  /// Activity, and by how much the gain falls for it. Returns when the gain has let go of the
  /// signal, from the burst's begin; infinite where it does not.
  double charge(const LevelCrossing& activity);

  LightSpell light(const LevelCrossing& signal, double until_off) const;

  /// When what is left of the burst falls below a level, in dB over that of the comparator with the
  /// gain at rest, or below that of the comparator that follows.
  double falls_below(double fixed_db) const;

  BurstOutput reported(double start_s);

  const RuleConstants& c_;
  PartMemory memory_;
  double margin_;
  StepResponse response_{};
  double on_s_ = 0;
  Rest between_{};  // bursts of the step
  bool is_first_ = true;
  double longer_ = 0;  // a spell lasts beyond the crossing, s
  BurstShape shape_;
  std::size_t signal_begin_ = 0, activity_begin_ = 0;
  LightSpell light_;
};

}  // namespace sim
