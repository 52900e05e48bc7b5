#include "sim/fit/bench_light.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sim {
namespace {

/// Shorter pulses are not what they are said to be: what charges the wires and the LED then counts.
constexpr int shortest_pulse = 6, shortest_weak_pulse = 4;

int shortest_by(const BenchResistor& resistor) {
  return &resistor == &bench_resistors.back() ? shortest_weak_pulse : shortest_pulse;
}

int longest_pulse(int period) { return static_cast<int>(std::floor(period * widest_pulse)); }

double decibels(double ratio) { return 20 * std::log10(ratio); }

double rounded_db(double db) { return std::round(db * 100) / 100 + 0.0; }  // no -0

/// Behind a step, until its next one has its first pulse.
std::uint64_t clocks_between(const BenchStep& step, const BenchStep& next) {
  return std::uint64_t{own_gap(step) - 1} * static_cast<std::uint64_t>(step.period) +
         (std::uint64_t{next.lead} + 1) * static_cast<std::uint64_t>(next.period);
}

/// From the first pulse to the end of the last burst.
std::uint64_t clocks_within(const BenchStep& step) {
  const std::uint64_t cycles =
      std::uint64_t{step.repeats} * step.on + std::uint64_t{step.repeats - 1} * step.off;
  return cycles * static_cast<std::uint64_t>(step.period);
}

double milliseconds(std::uint64_t clocks) {
  return 1e3 * static_cast<double>(clocks) / bench_clock_hz;
}

}  // namespace

BenchLevels::BenchLevels(channel::EmitterData led, int first_period)
    : led_(std::move(led)),
      first_period_(first_period),
      first_(fundamental(bench_resistors.front(), longest_pulse(first_period), first_period)) {}

double BenchLevels::fundamental(const BenchResistor& resistor, double width, int period) const {
  const double intensity =
      channel::axial_intensity(led_, dsp::Amperes(resistor.led_ma * 1e-3)).value;
  return intensity * std::sin(M_PI * width / period);
}

BenchPulse BenchLevels::pulse_by(const BenchResistor& resistor, double level_db, int period) const {
  const double wanted = first_ * std::pow(10, level_db / 20);
  const double share = wanted / fundamental(resistor, period / 2.0, period);
  const double width = share < 1 ? period / M_PI * std::asin(share) : period;
  const int whole = std::clamp(static_cast<int>(std::lround(width)), shortest_by(resistor),
                               longest_pulse(period));
  return {resistor.pin, whole, rounded_db(decibels(fundamental(resistor, whole, period) / first_))};
}

const BenchResistor& BenchLevels::resistor_for(double level_db) const {
  constexpr double no_matter_db = 0.3;  // the stronger current is the better known
  const auto error = [&](const BenchResistor& resistor) {
    return std::abs(pulse_by(resistor, level_db, first_period_).level_db - level_db);
  };
  const BenchResistor* best = bench_resistors.data();
  for (const BenchResistor& resistor : bench_resistors)
    if (error(resistor) < error(*best) - no_matter_db) best = &resistor;
  return *best;
}

BenchPulse BenchLevels::pulse(double level_db, int period) const {
  return pulse_by(resistor_for(level_db), level_db, period);
}

double BenchLevels::irradiance_at_1_m() const { return 1e3 * first_; }

std::uint32_t own_gap(const BenchStep& step) { return std::max<std::uint32_t>(step.off, 1); }

std::vector<std::uint64_t> starts_of(const BenchSchedule& schedule) {
  std::vector<std::uint64_t> starts;
  std::uint64_t now = 0;
  const BenchStep* before = nullptr;
  for (const BenchStep& step : schedule.steps) {
    if (before != nullptr)
      now += clocks_within(*before) + clocks_between(*before, step);
    else
      now += (std::uint64_t{step.lead} + 1) * static_cast<std::uint64_t>(step.period);
    starts.push_back(now);
    before = &step;
  }
  return starts;
}

std::uint64_t clocks_of(const BenchSchedule& schedule) {
  BenchSchedule with_end = schedule;
  BenchStep end = schedule.steps.back();
  end.lead = schedule.tail;
  with_end.steps.push_back(end);
  return starts_of(with_end).back();
}

Plan plan_of(const BenchSchedule& schedule) {
  const std::vector<std::uint64_t> starts = starts_of(schedule);
  Plan plan;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const BenchStep& step = schedule.steps[i];
    plan.steps.push_back({.start_ms = milliseconds(starts[i]),
                          .carrier_hz = bench_clock_hz / step.period,
                          .cycles_on = step.on,
                          .cycles_off = step.off,
                          .repeats = step.repeats,
                          .level_db = step.pulse.level_db});
  }
  return plan;
}

}  // namespace sim
