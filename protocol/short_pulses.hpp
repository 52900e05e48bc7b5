#pragma once
// One short pulse of light for each zero bit, at its start, in place of light for the whole bit: a
// receiver module takes it for the short burst that it is made for (return to zero, as IrDA SIR has
// it with pulses of 3/16 bit). What reads a module's output must make whole bits of the pulses
// before a UART can read them.
#include <cstdint>

#include "dsp/logic_trace.hpp"
#include "dsp/units.hpp"

namespace protocol {

/// As send_byte(), with each zero bit low for `pulse` only. A pulse of 0 is the whole bit.
dsp::Seconds send_byte_in_pulses(dsp::LogicTrace& line, std::uint8_t byte, dsp::Seconds start,
                                 dsp::Hertz baud, dsp::Seconds pulse);

/// What a monostable of one bit makes of a pin: from each fall on it is low for a bit, or for as
/// long as the pin is, if that is longer. A fall before its end begins it anew.
dsp::LogicTrace whole_bits(const dsp::LogicTrace& pin, dsp::Hertz baud);

}  // namespace protocol
