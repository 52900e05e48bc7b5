#pragma once
// A trial that never was: one message at 600 Bd, 0.1 s after the beginning, and what is read of it
// 200 us later.
#include <cstdint>
#include <string>

#include "protocol/uart.hpp"
#include "sim/trace/trace.hpp"

namespace sim {

constexpr dsp::Hertz made_up_baud(600);

inline void send_at(dsp::LogicTrace& wire, const std::string& text, double at_s) {
  dsp::Seconds at(at_s);
  for (const char c : text)
    at = protocol::send_byte(wire, static_cast<std::uint8_t>(c), at, made_up_baud);
  wire.observe_until(dsp::Seconds(0.5));
}

/// Without taps.
inline TracedTrial made_up_trial(const std::string& sent, const std::string& read) {
  TracedTrial trial;
  trial.baud = made_up_baud;
  send_at(trial.tx, sent, 0.1);
  send_at(trial.rx, read, 0.1002);
  return trial;
}

}  // namespace sim
