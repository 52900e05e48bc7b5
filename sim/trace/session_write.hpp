#pragma once
// A traced trial as a session of sigrok and PulseView (.sr): the wires tx and rx, and beside them
// every tap as an analogue channel, where there are taps. Sample i is the level at i sample
// periods; a tap's first reading, at one period, stands for the instant 0 too. Without taps the
// rate is 1 MHz.
#include <filesystem>
#include <string>

#include "sim/trace/trace.hpp"

namespace sim {

/// The whole file: equal traces give equal bytes.
std::string trace_as_session(const TracedTrial& trial);

/// One wire alone, called rx, at that many samples a second.
std::string wire_as_session(const dsp::LogicTrace& wire, dsp::Hertz rate);

/// Whether a file is such a session, not one of somebody's logic analyser.
bool is_session_of_trace(const std::filesystem::path& path);

}  // namespace sim
