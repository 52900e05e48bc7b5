#pragma once
// One trial with every tap of the receiver: the one that a run counts, same point and number, same
// bits. What each file format writes is read from here.
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "channel/chain.hpp"
#include "dsp/logic_trace.hpp"
#include "sim/program_info.hpp"
#include "sim/scenario/scenario.hpp"

namespace sim {

/// Where a trace comes from, enough to repeat it.
struct TraceOrigin {
  ProgramInfo program;
  std::string scenario_toml;
  std::uint64_t seed = 0, point = 0;
  std::uint32_t trial = 0;
};

struct TracedTrial {
  dsp::LogicTrace tx, rx;   // the wire that keys the LED, and the module's pin
  channel::Recording taps;  // empty where no samples are made (sim/scenario/fidelity)
  dsp::Hertz sample_rate;
  dsp::Hertz carrier{}, baud{};  // the device's true ones
  dsp::Seconds delay{};      // constant part, light to pin: ideal receivers decide at a bit's end
  bool has_slow_agc = true;  // or its tap stands still
  bool has_pulses = false;   // of light, one for each zero bit
  bool has_monostable = false;  // that makes whole bits of them before the UART
  std::string pin = "rx";       // what formats call the module's pin that name their wires
  TraceOrigin origin{};
};

/// Re-runs trial `trial` of the point that `scenario` is; the origin is left to the caller.
TracedTrial trace_trial(const Scenario& scenario, std::uint32_t trial);

/// The bits that were sent, and what a UART reads: the two wires, if light is in whole bits.
dsp::LogicTrace sent_line(const TracedTrial& trial);
dsp::LogicTrace read_line(const TracedTrial& trial);

/// The instants at which the taps were read, one a sample: the end of the sample.
std::vector<double> sample_times_s(const TracedTrial& trial);

/// The level of a wire at these instants.
std::vector<std::uint8_t> levels_at(const dsp::LogicTrace& wire, std::span<const double> times_s);

/// The analogue taps in the order of the signal's way.
struct Tap {
  const char* name;
  const char* unit;
  const char* long_name;
  std::vector<float> channel::Recording::*samples;
};
std::span<const Tap> analogue_taps();

/// Whether there is anything to be seen in a tap: of matched receivers only the light is recorded,
/// and a part of fixed gain has no AGC.
bool tells_something(const TracedTrial& trial, std::vector<float> channel::Recording::*samples);

}  // namespace sim
