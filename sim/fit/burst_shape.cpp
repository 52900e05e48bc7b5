#include "sim/fit/burst_shape.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/fit/gain_state.hpp"

namespace sim {
namespace {

using std::numbers::pi;

/// As std::abs, without its care for numbers that no light has.
double magnitude(const Phasor& z) { return std::sqrt(std::norm(z)); }

}  // namespace

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

void BurstShape::play(const StepResponse& response, double on_s, const RuleConstants& c,
                      Phasor ringing, double peak) {
  constexpr double no_matter = 1e-10;
  if (!cycles_.empty() && magnitude(ringing - ringing_before_) <= no_matter * end_ &&
      std::abs(peak - peak_before_) <= no_matter * peak)
    return;
  ringing_before_ = ringing;
  peak_before_ = peak;
  cycles_.clear();
  rise_begin_ = rise_end_ = 0;
  least_behind_rise_ = HUGE_VAL;
  greatest_ = 0;
  Phasor away = ringing - response.steady;
  double before = magnitude(ringing);
  double t = 0;
  const double atc_step = std::exp(-response.cycle_s / c.atc_release_s);
  const double steady = magnitude(response.steady);
  for (int k = 0; t < on_s; ++k) {
    if (k >= response.settling && c.atc_fraction * peak <= steady) break;
    const double dt = std::min(response.cycle_s, on_s - t);
    away *= dt < response.cycle_s ? std::exp(response.pole * dt) : response.step;
    const double after = magnitude(response.steady + away);
    peak = std::max(after, peak * atc_step);
    take({t, dt, before, after, c.atc_fraction * peak});
    before = after;
    t += dt;
  }
  ringing_ = response.steady + away;
  end_ = magnitude(ringing_);
  end_db_ = decibels_of(end_ / c.threshold);
  peak_ = t < on_s ? std::max(peak * std::exp(-(on_s - t) / c.atc_release_s), end_) : peak;
  end_over_following_db_ = decibels_of(end_ / (c.atc_fraction * peak_));
}

void BurstShape::take(const BurstCycle& cycle) {
  const std::size_t place = cycles_.size();
  cycles_.push_back(cycle);
  greatest_ = std::max(greatest_, cycle.after);
  const bool is_above = cycle.after > cycle.following;
  if (!is_above && rise_begin_ == place)
    rise_begin_ = rise_end_ = place + 1;
  else if (is_above && rise_end_ == place && cycle.after >= cycle.before)
    ++rise_end_;
  else
    least_behind_rise_ = is_above ? std::min(least_behind_rise_, cycle.after) : 0;
}

double share_above(double level, double peak) {
  if (peak <= level) return 0;
  const double x = level / peak;
  const double arc =
      std::sqrt(1 - x) * (1.5707288 + x * (-0.2121144 + x * (0.0742610 - 0.0187293 * x)));
  return arc / (2 * pi);
}

void LevelCrossing::step(const BurstCycle& cycle) {
  const double now = std::max(level, cycle.following);
  if (!above && cycle.after > now) {
    const double rise = cycle.after - cycle.before;
    const double share = cycle.before >= now || rise <= 0 ? 0 : (now - cycle.before) / rise;
    // The first peak above the level comes half a cycle later, and is above it for a while.
    if (!seen)
      from = cycle.t + share * cycle.dt + (0.5 - 2 * share_above(now, now + rise / 2)) * cycle.dt;
    above = seen = true;
  } else if (above && cycle.after <= now) {
    const double fall = cycle.before - cycle.after;
    const double share = fall > 0 ? std::clamp((cycle.before - now) / fall, 0.0, 1.0) : 0;
    to = cycle.t + share * cycle.dt;
    above = false;
  }
}

LevelCrossing crossing_of(const BurstShape& shape, double level, std::size_t& begin) {
  LevelCrossing crossing{level};
  if (level >= shape.greatest()) return crossing;
  const std::vector<BurstCycle>& cycles = shape.cycles();
  if (shape.rise_begin() == shape.rise_end() || level >= shape.least_behind_rise()) {
    for (const BurstCycle& cycle : cycles) crossing.step(cycle);
    return crossing;
  }
  begin = std::clamp(begin, shape.rise_begin(), shape.rise_end() - 1);
  while (begin > shape.rise_begin() && cycles[begin - 1].after > level) --begin;
  while (begin + 1 < shape.rise_end() && cycles[begin].after <= level) ++begin;
  crossing.step(cycles[begin]);
  return crossing;
}

}  // namespace sim
