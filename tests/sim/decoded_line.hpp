#pragma once
// A line with one message on it, and what decode says of lines.
#include <algorithm>
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

/// The object that ends the output of decode --json.
inline nlohmann::json line_facts(const std::string& out) {
  const std::size_t at = out.rfind("{\"line\"");
  return nlohmann::json::parse(out.substr(std::min(at, out.size()))).at("line");
}
