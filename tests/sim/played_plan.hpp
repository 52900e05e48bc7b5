#pragma once
// A plan's light as a module hears it, and both as captures: what somebody at a bench records.
#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "channel/receiver_module.hpp"
#include "sim/fit/plan_text.hpp"

namespace sim {

/// Calls `burst` with the begin and end of each burst of a plan, in seconds, and its step.
inline void for_each_burst(const Plan& plan,
                           const std::function<void(double, double, const PlanStep&)>& burst) {
  for (const PlanStep& step : plan.steps)
    for (std::uint64_t i = 0; i < step.repeats; ++i) {
      const double cycle_s = 1 / step.carrier_hz;
      const double begin_s =
          step.start_ms * 1e-3 +
          static_cast<double>(i) * cycle_s * static_cast<double>(step.cycles_on + step.cycles_off);
      burst(begin_s, begin_s + cycle_s * static_cast<double>(step.cycles_on), step);
    }
}

/// Times at which a wire changes.
using WireChanges = std::vector<double>;

/// What a module's output does, sample by sample; the first level is that of the plan's first step.
inline WireChanges changes_of_output(const Plan& plan, const channel::ModuleData& module,
                                     double first_level_mw_per_m2) {
  constexpr double rate_hz = 250e3;
  constexpr double watched_s = 0.5;  // behind the last burst
  channel::ReceiverModule<float> receiver(
      channel::design_module(module, dsp::WattsPerSquareMetre(0), dsp::Hertz(rate_hz)));
  WireChanges changes;
  bool level = true;
  std::size_t sample = 0;
  const auto hear = [&](double irradiance) {
    const bool now = receiver.demodulated(receiver.filtered(static_cast<float>(irradiance)));
    if (now != level) changes.push_back(static_cast<double>(sample) / rate_hz);
    level = now;
    ++sample;
  };
  const auto time_s = [&] { return static_cast<double>(sample) / rate_hz; };
  double end_s = 0;
  for_each_burst(plan, [&](double begin_s, double burst_end_s, const PlanStep& step) {
    const double level_mw = first_level_mw_per_m2 * std::pow(10, step.level_db / 20);
    while (time_s() < begin_s) hear(0);
    while (time_s() < burst_end_s) {
      const double cycles = (time_s() - begin_s) * step.carrier_hz;
      hear(cycles - std::floor(cycles) < 0.5 ? level_mw : 0);
    }
    end_s = burst_end_s + watched_s;
  });
  while (time_s() < end_s) hear(0);
  return changes;
}

/// A level for as long as light is on, as a bench's D7 has it.
inline WireChanges changes_of_mark(const Plan& plan) {
  WireChanges changes;
  for_each_burst(plan, [&](double begin_s, double end_s, const PlanStep&) {
    changes.push_back(begin_s);
    changes.push_back(end_s);
  });
  return changes;
}

/// The carrier's pulses, each a third of its cycle.
inline WireChanges changes_of_carrier(const Plan& plan) {
  WireChanges changes;
  for_each_burst(plan, [&](double begin_s, double, const PlanStep& step) {
    for (std::uint64_t i = 0; i < step.cycles_on; ++i) {
      const double pulse_s = begin_s + static_cast<double>(i) / step.carrier_hz;
      changes.push_back(pulse_s);
      changes.push_back(pulse_s + 1 / (3 * step.carrier_hz));
    }
  });
  return changes;
}

struct RecordedWire {
  std::string name;
  bool initial;
  WireChanges changes;
};

/// As a CSV of changes, in microseconds.
inline std::string capture_of(std::vector<RecordedWire> wires) {
  std::string text = "time_us";
  for (const RecordedWire& wire : wires) text += "," + wire.name;
  std::vector<std::size_t> next(wires.size(), 0);
  const auto row = [&](double time_s) {
    text += fmt::format("\n{:.3f}", time_s * 1e6);
    for (std::size_t i = 0; i < wires.size(); ++i)
      text += wires[i].initial != (next[i] % 2 == 1) ? ",1" : ",0";
  };
  row(0);
  for (;;) {
    const RecordedWire* first = nullptr;
    for (const RecordedWire& wire : wires) {
      const auto at = [&](const RecordedWire& w) {
        const std::size_t i = static_cast<std::size_t>(&w - wires.data());
        return next[i] < w.changes.size() ? w.changes[next[i]] : INFINITY;
      };
      if (at(wire) < INFINITY && (first == nullptr || at(wire) < at(*first))) first = &wire;
    }
    if (first == nullptr) return text + "\n";
    const auto i = static_cast<std::size_t>(first - wires.data());
    const double time_s = first->changes[next[i]++];
    row(time_s);
  }
}

}  // namespace sim
