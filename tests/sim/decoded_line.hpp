#pragma once
// A line with one message on it, and what decode says of lines.
#include <nlohmann/json.hpp>
#include <string>

#include "protocol/uart.hpp"

inline dsp::LogicTrace message_line(double baud) {
  dsp::LogicTrace line;
  dsp::Seconds at(0.02);
  for (const char byte : std::string("IND 011111 OK 46\n"))
    at = protocol::send_byte(line, static_cast<std::uint8_t>(byte), at, dsp::Hertz(baud));
  line.observe_until(at + dsp::Seconds(0.02));
  return line;
}

inline const std::string its_message = "   0.020000 s  ok              IND 011111 OK\n";

/// What the last line of decode --json says of the line; nothing where it failed.
inline nlohmann::json line_facts(const std::string& out) {
  const std::string rows = "\n" + out.substr(0, out.find_last_not_of('\n') + 1);
  const auto last = nlohmann::json::parse(rows.substr(rows.rfind('\n')), nullptr, false);
  return last.is_object() ? last.value("line", nlohmann::json()) : nlohmann::json();
}
