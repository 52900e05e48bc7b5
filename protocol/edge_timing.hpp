#pragma once
// A receiver that measures pulses instead of sampling bits, as rtl_433 and many remote-control
// libraries do: the time between two changes of the wire is so many bits, rounded. A pulse of less
// than half a bit is none. A wrong clock's error does not add up over a character, but where a
// pulse is taken for a bit more or less, all that follows it is shifted.
#include "protocol/uart.hpp"

namespace protocol {

/// rtl_433's pulse_slicer_pcm with equal widths for pulse and gap (src/pulse_slicer.c at 19cf2fc),
/// without its tuning of the bit's width to what it hears. A stop bit that is low is a framing
/// error, behind which the next character starts with a fall.
UartReading read_edge_timing(const dsp::LogicTrace& line, dsp::Hertz baud);

}  // namespace protocol
