#include "sim/fit/output_rule.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

namespace sim {
namespace {

using std::numbers::pi;
using Phasor = std::complex<double>;

/// 10^(db / 20).
double gain_of(double db) { return std::exp(db * (std::numbers::ln10 / 20)); }
double decibels_of(double ratio) { return (20 / std::numbers::ln10) * std::log(ratio); }

/// From when to when something is above its level; none: they are equal.
struct Spell {
  double from = 0, to = 0;
  double length() const { return to - from; }
};

/// The slow AGC between two moments of activity.
class GainState {
 public:
  explicit GainState(const RuleConstants& c) : c_(c) {}

  double db() const { return db_; }
  double burst_s() const { return burst_; }

  /// Without activity for so long, since the last one or the last call.
  void rest(double s) {
    const double before = std::max(quiet_ - c_.dark_hold_s, 0.0);
    quiet_ += s;
    const double recovered = std::max(quiet_ - c_.dark_hold_s, 0.0) - before;
    db_ = std::max(db_ - c_.release_db_per_s * recovered, 0.0);
  }

  /// How far it would be down after so long a rest.
  double db_after(double s) const {
    GainState later = *this;
    later.rest(s);
    return later.db_;
  }

  /// Time of activity from now until the gain has fallen to `db`; infinite where it never does.
  double time_to(double db) const {
    if (db <= db_) return 0;
    if (db > c_.range_db || c_.attack_db_per_s <= 0) return HUGE_VAL;
    const double burst = burst_now();
    if (burst > c_.long_burst_s) return (db - db_) / c_.attack_db_per_s;
    const double counted = (db - db_) / c_.attack_db_per_s + c_.free_s;
    return std::max(counted, c_.long_burst_s) - burst;
  }

  /// Activity for so long; the gain falls no further than to `most_db`.
  void active(double s, double most_db) {
    if (s <= 0) return;
    const double before = burst_now();
    const double burst = before + s;
    quiet_ = 0;
    burst_ = burst;
    if (burst <= c_.long_burst_s) return;
    const double charged =
        before > c_.long_burst_s ? s : burst - std::min(c_.free_s, c_.long_burst_s);
    const double most = std::min(std::max(most_db, db_), c_.range_db);
    db_ = std::min(db_ + c_.attack_db_per_s * charged, most);
  }

 private:
  double burst_now() const { return quiet_ > c_.min_gap_s ? 0 : burst_; }

  const RuleConstants& c_;
  double db_ = 0;
  double burst_ = 0;  // activity since the last gap, s
  double quiet_ = 1e9;
};

/// Counts up in light and down in dark; the output follows at the stops.
class Integrator {
 public:
  explicit Integrator(double top_s) : top_(top_s) {}

  struct Pulse {
    double start = 0, over = 0;  // `over`: by how much the top was, or would have been, passed
    bool begins = false;
  };

  /// Light in a spell; both since the last spell's end are dark until then. Times are absolute.
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

/// A step's light at the resonator.
struct StepResponse {
  double cycle_s;  // of the carrier
  Phasor steady;   // amplitude that is reached
  Phasor pole;     // 1/s: how what is left of the way to it falls
  Phasor step;     // what is left of it a cycle later
  double decay_s;  // time constant
  int settling;    // cycles until it is reached to half a per cent
};

StepResponse response_of(const PlanStep& step, double amplitude, const RuleConstants& c) {
  const double f = step.carrier_hz, f0 = c.centre_hz;
  const double detuning = c.q * (f / f0 - f0 / f);
  const double decay_s = c.q / (pi * f0);
  const double free_hz = f0 * std::sqrt(std::max(1 - 1 / (4 * c.q * c.q), 0.0));
  const double cycle_s = 1 / f;
  StepResponse response{};
  response.cycle_s = cycle_s;
  response.steady = amplitude / Phasor(1, detuning);
  response.pole = Phasor(-1 / decay_s, 2 * pi * (free_hz - f));
  response.step = std::exp(response.pole * cycle_s);
  response.decay_s = decay_s;
  response.settling = static_cast<int>(std::ceil(5.3 * decay_s / cycle_s));
  return response;
}

/// Bursts one after the other.
class OutputOfRule {
 public:
  explicit OutputOfRule(const RuleConstants& c)
      : c_(c), gain_(c), integrator_(c.integrator_s), margin_(gain_of(-c.margin_db)) {}

  BurstOutput burst(const StepResponse& response, double start_s, double on_s) {
    rest_until(start_s, response);
    rise(response, on_s);
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
  void rest_until(double start_s, const StepResponse& response) {
    const double dark = start_s - now_;
    if (dark > 0) {
      ringing_ =
          dark > 40 * response.decay_s ? Phasor(0) : ringing_ * std::exp(response.pole * dark);
      peak_ *= std::exp(-dark / c_.atc_release_s);
    }
    now_ = start_s;
  }

  /// The whole burst: which spells of it the comparator and the AGC see.
  void rise(const StepResponse& response, double on_s) {
    const double quiet = std::max(now_ - active_until_, 0.0);
    const double gain_db = gain_.db_after(quiet);
    const double fixed = c_.threshold * gain_of(gain_db);
    Crossing signal{fixed}, activity{fixed * margin_};
    Phasor away = ringing_ - response.steady;
    double before = std::abs(ringing_);
    double t = 0;
    const double atc_step = std::exp(-response.cycle_s / c_.atc_release_s);
    const double steady = std::abs(response.steady);
    for (int k = 0; t < on_s; ++k) {
      if (k >= response.settling && c_.atc_fraction * peak_ <= steady) break;
      const double dt = std::min(response.cycle_s, on_s - t);
      away *= dt < response.cycle_s ? std::exp(response.pole * dt) : response.step;
      const double after = std::abs(response.steady + away);
      peak_ = std::max(after, peak_ * atc_step);
      const double following = c_.atc_fraction * peak_;
      signal.step(t, dt, before, after, following);
      activity.step(t, dt, before, after, following);
      before = after;
      t += dt;
    }
    const double settled = t;
    ringing_ = response.steady + away;
    const double end = std::abs(ringing_);
    if (settled < on_s)
      peak_ = std::max(peak_ * std::exp(-(on_s - settled) / c_.atc_release_s), end);
    finish(response, on_s, end, signal, activity);
  }

  /// Which share of a cycle lies between a peak and where the wave passes a level below it.
  static double share_above(double level, double peak) {
    return peak > level ? std::acos(level / peak) / (2 * pi) : 0;
  }

  /// When something passes its level on the way up, and down again.
  struct Crossing {
    double level;
    bool above = false;
    double from = 0, to = 0;
    bool seen = false;

    void step(double t, double dt, double before, double after, double following) {
      const double now = std::max(level, following);
      if (!above && after > now) {
        const double rise = after - before;
        const double share = before >= now || rise <= 0 ? 0 : (now - before) / rise;
        // The first peak above the level comes half a cycle later, and is above it for a while.
        if (!seen) from = t + share * dt + (0.5 - 2 * share_above(now, now + rise / 2)) * dt;
        above = seen = true;
      } else if (above && after <= now) {
        const double fall = before - after;
        to = t + (fall > 0 ? std::clamp((before - now) / fall, 0.0, 1.0) : 0) * dt;
        above = false;
      }
    }
  };

  /// What follows of the crossings: activity and what it costs, light and what it gives.
  void finish(const StepResponse& response, double on_s, double end, const Crossing& signal,
              const Crossing& activity) {
    const double cycle = response.cycle_s;
    // The last peak above the level is half a cycle before the crossing, and above it for a while.
    const double falling = std::exp(-0.5 * cycle / response.decay_s);
    const double longer = c_.hold_s - (0.5 - share_above(falling, 1)) * cycle;
    light_ = {};
    const double following = c_.atc_fraction * peak_;
    if (activity.seen) {
      const double from = now_ + activity.from;
      gain_.rest(std::max(from - active_until_, 0.0));
      const double lets_go_db = decibels_of(end / c_.threshold);
      double to = activity.to;
      double until_off = HUGE_VAL;  // of the signal, by the gain
      if (activity.above) {
        const double during = std::max(on_s - activity.from, 0.0);
        const double reached = gain_.time_to(lets_go_db);
        if (reached < during) until_off = activity.from + reached;
        GainState later = gain_;
        later.active(during, lets_go_db + c_.margin_db);
        const double level = std::max(c_.threshold * gain_of(later.db()) * margin_, following);
        to = on_s + (end > level ? response.decay_s * std::log(end / level) : 0);
      }
      const double until = std::max(now_ + to + longer, from);
      gain_.active(until - from, lets_go_db + c_.margin_db);
      active_until_ = until;
      light(response, on_s, end, signal, until_off, longer);
    }
    now_ += on_s;
  }

  void light(const StepResponse& response, double on_s, double end, const Crossing& signal,
             double until_off, double longer) {
    if (!signal.seen) return;
    double to = signal.to;
    if (signal.above && until_off < on_s) {
      to = until_off;
    } else if (signal.above) {
      const double level = std::max(c_.threshold * gain_of(gain_.db()), c_.atc_fraction * peak_);
      to = on_s + (end > level ? response.decay_s * std::log(end / level) : 0);
    }
    light_ = {now_ + signal.from, std::max(now_ + to + longer, now_ + signal.from)};
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

void output_of_rule(const Plan& plan, const RuleConstants& constants,
                    std::span<const double> amplitudes, std::vector<BurstOutput>& bursts) {
  bursts.clear();
  OutputOfRule output(constants);
  for (std::size_t s = 0; s < plan.steps.size(); ++s) {
    const PlanStep& step = plan.steps[s];
    const StepResponse response = response_of(step, amplitudes[s], constants);
    const double on_s = static_cast<double>(step.cycles_on) * response.cycle_s;
    const double period_s = on_s + static_cast<double>(step.cycles_off) * response.cycle_s;
    auto before = output.state();
    for (std::uint64_t i = 0; i < step.repeats; ++i) {
      bursts.push_back(
          output.burst(response, step.start_ms * 1e-3 + static_cast<double>(i) * period_s, on_s));
      const auto after = output.state();
      if (i > 0 && alike(before, after)) {  // so are all that follow
        const std::uint64_t left = step.repeats - 1 - i;
        bursts.insert(bursts.end(), left, bursts.back());
        output.skip(static_cast<double>(left) * period_s);
        break;
      }
      before = after;
    }
  }
}

}  // namespace sim
