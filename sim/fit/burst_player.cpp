#include "sim/fit/burst_player.hpp"

namespace sim {

bool BurstPlayer::goes_on_as(const PartMemory& other, const StepResponse& response,
                             double start_s) const {
  const auto gain_then = [&](const PartMemory& m) {
    GainState gain = m.gain;
    gain.rest(std::max(start_s - m.active_until, 0.0));
    return gain;
  };
  const auto rest_then = [&](const PartMemory& m) {
    const Rest rest = rest_of(start_s - m.now, response);
    return Rest{m.ringing * rest.ringing, m.peak * rest.peak};
  };
  const Rest one = rest_then(memory_), another = rest_then(other);
  // A level that follows does not matter below the least one that is fixed.
  const double least = c_.threshold * margin_ / c_.atc_fraction;
  constexpr double no_matter = 1e-9;
  return gain_then(memory_).goes_on_as(gain_then(other)) &&
         memory_.integrator.goes_on_as(other.integrator, start_s) &&
         std::abs(one.ringing - another.ringing) <= no_matter * least &&
         (std::max(one.peak, another.peak) < least || is_nearly(one.peak, another.peak));
}

void BurstPlayer::begin_step(const StepResponse& response, double on_s, double off_s) {
  response_ = response;
  on_s_ = on_s;
  between_ = rest_of(off_s, response);
  is_first_ = true;
  shape_.forget();
  // The last peak above the level is half a cycle before the crossing, and above it for a while.
  const double falling = std::exp(-0.5 * response.cycle_s / response.decay_s);
  longer_ = c_.hold_s - (0.5 - share_above(falling, 1)) * response.cycle_s;
}

BurstOutput BurstPlayer::burst(double start_s) {
  rest_until(start_s);
  rise();
  return reported(start_s);
}

std::array<double, 7> BurstPlayer::state() const {
  return {memory_.gain.db(),
          memory_.gain.burst_s(),
          memory_.now - memory_.active_until,
          memory_.peak,
          memory_.ringing.real(),
          memory_.ringing.imag(),
          memory_.integrator.level_s()};
}

void BurstPlayer::skip(double s) {
  memory_.now += s;
  memory_.active_until += s;
  memory_.integrator.skip(s);
}

BurstPlayer::Rest BurstPlayer::rest_of(double dark_s, const StepResponse& response) const {
  if (dark_s <= 0) return {1, 1};
  return {dark_s > 40 * response.decay_s ? Phasor(0) : std::exp(response.pole * dark_s),
          std::exp(-dark_s / c_.atc_release_s)};
}

void BurstPlayer::rest_until(double start_s) {
  const Rest rest = is_first_ ? rest_of(start_s - memory_.now, response_) : between_;
  is_first_ = false;
  memory_.ringing *= rest.ringing;
  memory_.peak *= rest.peak;
  memory_.now = start_s;
}

void BurstPlayer::rise() {
  const double quiet = std::max(memory_.now - memory_.active_until, 0.0);
  const double fixed = c_.threshold * gain_of(memory_.gain.db_after(quiet));
  shape_.play(response_, on_s_, c_, memory_.ringing, memory_.peak);
  const LevelCrossing signal = crossing_of(shape_, fixed, signal_begin_);
  LevelCrossing activity = crossing_of(shape_, fixed * margin_, activity_begin_);
  memory_.ringing = shape_.ringing();
  memory_.peak = shape_.peak();
  if (!activity.seen) notice(activity);
  light_ = {};
  if (activity.seen) {
    const double until_off = charge(activity);
    if (signal.seen) light_ = light(signal, until_off);
  }
  memory_.now += on_s_;
}

void BurstPlayer::notice(LevelCrossing& activity) const {
  const double seen_db = shape_.end_db() + c_.margin_db;
  const double from = memory_.active_until + memory_.gain.rest_to(seen_db) - memory_.now;
  if (shape_.cycles().empty() || from < shape_.cycles().back().t || from > on_s_) return;
  activity.seen = activity.above = true;
  activity.from = from;
}

double BurstPlayer::charge(const LevelCrossing& activity) {
  const double from = memory_.now + activity.from;
  memory_.gain.rest(std::max(from - memory_.active_until, 0.0));
  const double lets_go_db = shape_.end_db();
  double to = activity.to;
  double until_off = HUGE_VAL;
  if (activity.above) {
    const double during = std::max(on_s_ - activity.from, 0.0);
    const double reached = memory_.gain.time_to(lets_go_db);
    if (reached < during) until_off = activity.from + reached;
    GainState later = memory_.gain;
    later.active(during, lets_go_db + c_.margin_db);
    to = falls_below(later.db() - c_.margin_db);
  }
  const double until = std::max(memory_.now + to + longer_, from);
  memory_.gain.active(until - from, lets_go_db + c_.margin_db);
  memory_.active_until = until;
  return until_off;
}

LightSpell BurstPlayer::light(const LevelCrossing& signal, double until_off) const {
  double to = signal.to;
  if (signal.above) to = until_off < on_s_ ? until_off : falls_below(memory_.gain.db());
  return {memory_.now + signal.from,
          std::max(memory_.now + to + longer_, memory_.now + signal.from)};
}

double BurstPlayer::falls_below(double fixed_db) const {
  const double left_db = std::min(shape_.end_db() - fixed_db, shape_.end_over_following_db());
  return on_s_ + std::max(left_db, 0.0) * response_.decay_s / decibels_a_decay;
}

BurstOutput BurstPlayer::reported(double start_s) {
  BurstOutput output;
  if (light_.length() <= 0) return output;
  const bool was_low = memory_.integrator.low();
  const double was_end = memory_.integrator.end_of_pulse();
  const PulseIntegrator::Pulse pulse = memory_.integrator.spell(light_);
  const double soft = 0.5 / c_.centre_hz;
  output.share = std::clamp(0.5 + pulse.over / (2 * soft), 0.0, 1.0);
  if (!memory_.integrator.low()) {
    output.low_s = output.share > 0 ? c_.integrator_s : 0;
    return output;
  }
  const double end = memory_.integrator.end_of_pulse();
  // A pulse that goes on from the burst before is low for what this one adds to it.
  output.begins = pulse.begins;
  output.start_s = pulse.begins ? pulse.start - start_s : 0;
  output.low_s = pulse.begins ? end - pulse.start : was_low ? end - was_end : 0;
  if (!pulse.begins) output.share = 1;
  return output;
}

}  // namespace sim
