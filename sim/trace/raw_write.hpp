#pragma once
// The wires of a traced trial as logic samples of a byte each: tx in bit 0, rx in bit 1. By
// themselves they are a raw file (.bin), which says neither its rate nor whose it is.
#include <string>

#include "sim/trace/trace.hpp"

namespace sim {

/// Of raw files, and of sessions without taps.
inline constexpr dsp::Hertz logic_rate{1e6};

/// Sample i is the level at i sample periods.
std::string logic_samples(const TracedTrial& trial, std::size_t count, dsp::Hertz rate);

/// Samples at logic_rate to the trial's end.
std::string trace_as_raw(const TracedTrial& trial);

}  // namespace sim
