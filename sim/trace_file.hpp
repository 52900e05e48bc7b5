#pragma once
// One trial with every tap of the receiver, in a file whose ending says the format. The trial is
// the one that a run counts: same point and number, same bits.
#include <cstdint>
#include <filesystem>

#include "channel/chain.hpp"
#include "dsp/logic_trace.hpp"
#include "sim/scenario.hpp"

namespace sim {

struct TracedTrial {
  dsp::LogicTrace tx, rx;  // the wire that keys the LED, and the module's pin
  channel::Recording taps;
  dsp::Hertz sample_rate;
};

/// Re-runs trial `trial` of the point that `scenario` is.
TracedTrial trace_trial(const Scenario& scenario, std::uint32_t trial);

/// .vcd: wires tx and rx; .csv: time and every tap, a row a sample.
void write_trace(const std::filesystem::path& path, const TracedTrial& trial);

/// Throws the Failure that write_trace would throw for this name, before any work is done.
void check_trace_path(const std::filesystem::path& path);

}  // namespace sim
