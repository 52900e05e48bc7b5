#pragma once
// The schedule as a sketch for an Arduino Uno (ATmega328P at 16 MHz), which plays it, records the
// module's output and sends each edge as a row of a CSV file that captures are read from. It uses
// the registers alone, so it is built by the Arduino IDE and by avr-gcc without Arduino's core.
#include <string>

#include "sim/fit/bench_light.hpp"

namespace sim {

/// Bits a second of the serial line; the clock makes them exactly.
inline constexpr int sketch_baud = 500000;

/// `module` is named in its first lines. The schedule has at most 1500 steps, which fit into the
/// flash, of numbers that fit into 16 bits (periods, gaps, repeats) and 32 (the rest).
std::string arduino_sketch(const BenchSchedule& schedule, const std::string& module);

}  // namespace sim
