#pragma once
// The light that an Arduino Uno makes of one LED: which levels it has, and by which pin and pulse.
// One pin gives the carrier to the LED's anode; three others have a resistor each to its cathode,
// of which one at a time is low and the others are open. A level between is a shorter pulse in
// each carrier cycle: a module's band-pass sees the fundamental, I sin(pi width / period).
#include <array>
#include <cstdint>
#include <vector>

#include "channel/emitter.hpp"
#include "sim/fit/plan_text.hpp"

namespace sim {

inline constexpr double bench_clock_hz = 16e6;

/// A resistor to the LED's cathode, on a pin of port D.
struct BenchResistor {
  int pin;
  double ohm;
  double led_ma;  // while the carrier is high
};
/// Strongest first. Currents are estimates, not measured: of 5 V the LED takes 1.3, 1.2 and 1.1 V,
/// both pins together some 55 Ohm.
inline constexpr std::array bench_resistors{BenchResistor{4, 100, 24}, BenchResistor{5, 1e3, 3.6},
                                            BenchResistor{6, 10e3, 0.39}};

inline constexpr int bench_carrier_pin = 10, bench_module_pin = 8, bench_mark_pin = 7;

/// The longest pulse as a share of the carrier's cycle. What follows it must last until an
/// interrupt has opened or closed the gate: 150 clocks at least.
inline constexpr double widest_pulse = 1.0 / 3;
/// Carriers that leave time for that, and for the serial line, in clocks a cycle.
inline constexpr int shortest_period = 250, longest_period = 1000;

/// A pulse of so many clocks in each carrier cycle, by a resistor.
struct BenchPulse {
  int pin = 0;
  int width = 0;
  double level_db =
      0;  // as a plan has it, of the fundamental; 0: the strongest at the first period
};

/// Levels of an LED at a first carrier.
class BenchLevels {
 public:
  BenchLevels(channel::EmitterData led, int first_period);

  /// The pulse that comes nearest to a level; of a level that none reaches, the nearest there is.
  /// A level has the same resistor on all carriers, so that they can be compared.
  BenchPulse pulse(double level_db, int period) const;

  /// Irradiance of the strongest one at 1 m on the axis: as the peak of a carrier that is on half
  /// of its cycle and has the same fundamental, mW/m2.
  double irradiance_at_1_m() const;

 private:
  const BenchResistor& resistor_for(double level_db) const;
  double fundamental(const BenchResistor& resistor, double width, int period) const;
  BenchPulse pulse_by(const BenchResistor& resistor, double level_db, int period) const;

  channel::EmitterData led_;
  int first_period_;
  double first_;  // fundamental of the strongest pulse
};

/// A step as the sketch plays it. All times are whole cycles of its own carrier.
struct BenchStep {
  int period = 0;  // clocks a cycle
  BenchPulse pulse;
  std::uint32_t lead = 1;  // cycles of dark before it, from 1 on
  std::uint32_t on = 1;    // of a burst
  std::uint32_t off = 0;   // behind each; 0 of one burst alone
  std::uint32_t repeats = 1;
};

struct BenchSchedule {
  std::vector<BenchStep> steps;
  std::uint32_t tail = 1;  // cycles of dark behind all, of the last carrier
};

/// Dark cycles of a step's own carrier behind its last burst: the sketch takes a new carrier one
/// cycle before the gap is over.
std::uint32_t own_gap(const BenchStep& step);

/// Clocks from the first one to the first pulse of each step, and to the end of all.
std::vector<std::uint64_t> starts_of(const BenchSchedule& schedule);
std::uint64_t clocks_of(const BenchSchedule& schedule);

/// The same for everybody else.
Plan plan_of(const BenchSchedule& schedule);

}  // namespace sim
