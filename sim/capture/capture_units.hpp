#pragma once
// Units of time and rate as instruments and people write them: "ms", "(usec)", "Seconds", "1
// MSa/s".
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "dsp/units.hpp"

namespace sim {

/// Of one word, brackets around it aside; nothing where it is no unit of time.
std::optional<dsp::Seconds> time_unit(std::string_view word);

/// Whether a field is nothing but a unit, of time, voltage or the like: "(V)", "Volt", "second".
bool is_unit_word(std::string_view field);

/// "96000", "1 MHz", "250 kSa/s", "1e6": a rate of 1 Hz to 1 THz, or nothing.
std::optional<dsp::Hertz> parse_sample_rate(std::string_view text);

/// "3.3e-4", "1.0us", "10 ns": a time, by itself in `unit`; nothing where it is none.
std::optional<dsp::Seconds> parse_interval(std::string_view text, dsp::Seconds unit);

/// How instants of a capture are told, for the user to read.
std::string samples_text(dsp::Hertz rate);
std::string ticks_text(dsp::Seconds tick);

/// What a heading says: "Time (ms)", "CH1 [V]", "time_us", "t/s", "in s", "CH1 in V", "seconds".
struct Heading {
  std::string name{};  // without its unit
  std::string unit{};  // as it is written, without brackets; empty: none
  std::string text{};  // all of it
};
Heading heading_of(std::string_view field);

/// "Time", "t", "Zeit": a heading's name, without its unit.
bool is_time_name(std::string_view name);
/// By its name or its unit.
bool is_of_time(const Heading& heading);
/// Whether one of these headings is that of a time.
bool names_time(std::span<const std::string> fields);

}  // namespace sim
