#include "sim/fit/output_rule.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "sim/fit/burst_shape.hpp"
#include "sim/fit/gain_state.hpp"

namespace sim {
namespace {

/// From when to when something is above its level; none: they are equal.
struct Spell {
  double from = 0, to = 0;
  double length() const { return to - from; }
};

/// Counts up in light and down in dark; the output follows at the stops.
class Integrator {
 public:
  explicit Integrator(double top_s) : top_(top_s) {}

  struct Pulse {
    double start = 0, over = 0;  // `over`: by how much the top was, or would have been, passed
    bool begins = false;
  };

  /// Light in a spell, and dark since the last one's end. Times are absolute.
  Pulse spell(const Spell& light) {
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

/// Bursts one after the other.
class OutputOfRule {
 public:
  explicit OutputOfRule(const RuleConstants& c)
      : c_(c), gain_(c), integrator_(c.integrator_s), margin_(gain_of(-c.margin_db)) {}

  /// Bursts that follow are of this step.
  void begin_step(const StepResponse& response, double on_s, double off_s) {
    response_ = response;
    on_s_ = on_s;
    between_ = rest_of(off_s);
    is_first_ = true;
    shape_.forget();
    // The last peak above the level is half a cycle before the crossing, and above it for a while.
    const double falling = std::exp(-0.5 * response.cycle_s / response.decay_s);
    longer_ = c_.hold_s - (0.5 - share_above(falling, 1)) * response.cycle_s;
  }

  BurstOutput burst(double start_s) {
    rest_until(start_s);
    rise();
    return reported(start_s);
  }

  /// What the next burst depends on, at the end of one.
  std::array<double, 7> state() const {
    return {gain_.db(),      gain_.burst_s(), now_ - active_until_, peak_,
            ringing_.real(), ringing_.imag(), integrator_.level_s()};
  }

  /// As if bursts had gone on for so long that change nothing.
  void skip(double s) {
    now_ += s;
    active_until_ += s;
    integrator_.skip(s);
  }

 private:
  /// What is left behind dark.
  struct Rest {
    Phasor ringing;
    double peak;
  };
  Rest rest_of(double dark_s) const {
    if (dark_s <= 0) return {1, 1};
    return {dark_s > 40 * response_.decay_s ? Phasor(0) : std::exp(response_.pole * dark_s),
            std::exp(-dark_s / c_.atc_release_s)};
  }

  void rest_until(double start_s) {
    const Rest rest = is_first_ ? rest_of(start_s - now_) : between_;
    is_first_ = false;
    ringing_ *= rest.ringing;
    peak_ *= rest.peak;
    now_ = start_s;
  }

  /// The whole burst: which spells of it the comparator and the AGC see.
  void rise() {
    const double quiet = std::max(now_ - active_until_, 0.0);
    const double fixed = c_.threshold * gain_of(gain_.db_after(quiet));
    shape_.play(response_, on_s_, c_, ringing_, peak_);
    const LevelCrossing signal = crossing_of(shape_, fixed, signal_begin_);
    LevelCrossing activity = crossing_of(shape_, fixed * margin_, activity_begin_);
    ringing_ = shape_.ringing();
    peak_ = shape_.peak();
    if (!activity.seen) notice(activity);
    light_ = {};
    if (activity.seen) {
      const double until_off = charge(activity);
      if (signal.seen) light_ = light(signal, until_off);
    }
    now_ += on_s_;
  }

  /// A burst that lasts until the gain has come back so far that it is activity.
  void notice(LevelCrossing& activity) const {
    const double seen_db = shape_.end_db() + c_.margin_db;
    const double from = active_until_ + gain_.rest_to(seen_db) - now_;
    if (shape_.cycles().empty() || from < shape_.cycles().back().t || from > on_s_) return;
    activity.seen = activity.above = true;
    activity.from = from;
  }

  /// Activity, and by how much the gain falls for it. Returns when the gain has let go of the
  /// signal, from the burst's begin; infinite where it does not.
  double charge(const LevelCrossing& activity) {
    const double from = now_ + activity.from;
    gain_.rest(std::max(from - active_until_, 0.0));
    const double lets_go_db = shape_.end_db();
    double to = activity.to;
    double until_off = HUGE_VAL;
    if (activity.above) {
      const double during = std::max(on_s_ - activity.from, 0.0);
      const double reached = gain_.time_to(lets_go_db);
      if (reached < during) until_off = activity.from + reached;
      GainState later = gain_;
      later.active(during, lets_go_db + c_.margin_db);
      to = falls_below(later.db() - c_.margin_db);
    }
    const double until = std::max(now_ + to + longer_, from);
    gain_.active(until - from, lets_go_db + c_.margin_db);
    active_until_ = until;
    return until_off;
  }

  Spell light(const LevelCrossing& signal, double until_off) const {
    double to = signal.to;
    if (signal.above) to = until_off < on_s_ ? until_off : falls_below(gain_.db());
    return {now_ + signal.from, std::max(now_ + to + longer_, now_ + signal.from)};
  }

  /// When what is left of the burst falls below a level, in dB over that of the comparator with the
  /// gain at rest, or below that of the comparator that follows.
  double falls_below(double fixed_db) const {
    const double left_db = std::min(shape_.end_db() - fixed_db, shape_.end_over_following_db());
    return on_s_ + std::max(left_db, 0.0) * response_.decay_s / decibels_a_decay;
  }

  BurstOutput reported(double start_s) {
    BurstOutput output;
    if (light_.length() <= 0) return output;
    const bool was_low = integrator_.low();
    const double was_end = integrator_.end_of_pulse();
    const Integrator::Pulse pulse = integrator_.spell(light_);
    const double soft = 0.5 / c_.centre_hz;
    output.share = std::clamp(0.5 + pulse.over / (2 * soft), 0.0, 1.0);
    if (!integrator_.low()) {
      output.low_s = output.share > 0 ? c_.integrator_s : 0;
      return output;
    }
    const double end = integrator_.end_of_pulse();
    // A pulse that goes on from the burst before is low for what this one adds to it.
    output.begins = pulse.begins;
    output.start_s = pulse.begins ? pulse.start - start_s : 0;
    output.low_s = pulse.begins ? end - pulse.start : was_low ? end - was_end : 0;
    if (!pulse.begins) output.share = 1;
    return output;
  }

  const RuleConstants& c_;
  GainState gain_;
  Integrator integrator_;
  double margin_;
  StepResponse response_{};
  double on_s_ = 0;
  Rest between_{};  // bursts of the step
  bool is_first_ = true;
  double longer_ = 0;  // a spell lasts beyond the crossing, s
  BurstShape shape_;
  std::size_t signal_begin_ = 0, activity_begin_ = 0;
  Phasor ringing_ = 0;  // at the end of the last burst, or at `now_`
  double now_ = -1e9;
  double active_until_ = -1e9;
  double peak_ = 0;  // that the comparator follows
  Spell light_;
};

bool alike(const std::array<double, 7>& one, const std::array<double, 7>& other) {
  constexpr double no_matter = 1e-9;
  for (std::size_t i = 0; i < one.size(); ++i)
    if (std::abs(one[i] - other[i]) > no_matter * std::abs(one[i])) return false;
  return true;
}

}  // namespace

bool output_of_rule(const Plan& plan, const RuleConstants& constants,
                    std::span<const double> amplitudes, std::vector<BurstOutput>& bursts,
                    const std::function<bool(std::size_t)>& look) {
  bursts.clear();
  OutputOfRule output(constants);
  for (std::size_t s = 0; s < plan.steps.size(); ++s) {
    const PlanStep& step = plan.steps[s];
    const StepResponse response = response_of(step, amplitudes[s], constants);
    const double on_s = static_cast<double>(step.cycles_on) * response.cycle_s;
    const double off_s = static_cast<double>(step.cycles_off) * response.cycle_s;
    const double period_s = on_s + off_s;
    output.begin_step(response, on_s, off_s);
    auto before = output.state();
    for (std::uint64_t i = 0; i < step.repeats; ++i) {
      bursts.push_back(output.burst(step.start_ms * 1e-3 + static_cast<double>(i) * period_s));
      const auto after = output.state();
      if (i > 0 && alike(before, after)) {  // so are all that follow
        const std::uint64_t left = step.repeats - 1 - i;
        bursts.insert(bursts.end(), left, bursts.back());
        output.skip(static_cast<double>(left) * period_s);
        break;
      }
      before = after;
    }
    if (!look(s)) return false;
  }
  return true;
}

}  // namespace sim
