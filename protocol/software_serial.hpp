#pragma once
// Arduino's SoftwareSerial as a receiver: a fall of the pin interrupts the program, which then
// counts cycles to the middle of each data bit. No stop bit is looked at, so there are no framing
// errors; falls before it listens again, a quarter into the stop bit, are not seen.
#include "protocol/uart.hpp"

namespace protocol {

/// Timing of an ATmega at 16 MHz as begin() sets it (ArduinoCore-avr, SoftwareSerial.cpp at
/// 1193f16, gcc later than 4.8): delays in units of four cycles, counted instructions between them.
/// The pin is read again within the 83 cycles behind a fall; here at their end. Bauds above 100
/// kBd need fewer cycles than it has.
UartReading read_software_serial(const dsp::LogicTrace& line, dsp::Hertz baud);

}  // namespace protocol
