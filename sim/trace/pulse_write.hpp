#pragma once
// A wire as pulse text for rtl_433 (.ook): a line for each pulse of light (the wire is 0) and the
// gap behind it, in whole microseconds. Idle time before the first pulse is not in it, nor are
// pulses and gaps that rounding leaves nothing of.
#include <iosfwd>
#include <string_view>

#include "dsp/logic_trace.hpp"

namespace sim {

/// Every file begins so.
inline constexpr std::string_view pulses_head =
    ";pulse data\n;version 1\n;timescale 1us\n;created cosys-sim\n";

/// The last gap ends with the wire. A wire that is 0 at its end or its start is in light there.
void write_pulses(std::ostream& out, const dsp::LogicTrace& wire);

}  // namespace sim
