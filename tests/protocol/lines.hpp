#pragma once
// Lines for the tests of this folder: random bytes, sent with any rate, and pulses bent as a
// receiver module bends them. Everything is a function of its seed.
#include <cstddef>
#include <random>

#include "protocol/uart.hpp"

namespace protocol::test {

using Random = std::mt19937_64;

inline constexpr dsp::Hertz baud{600};

inline double uniform(Random& random, double low, double high) {
  // not a standard distribution: those differ between libraries
  return low + (high - low) * static_cast<double>(random() >> 11U) * 0x1p-53;
}

inline Bytes random_bytes(Random& random, std::size_t count) {
  Bytes bytes(count);
  for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random() >> 56U);
  return bytes;
}

/// The bytes back to back after a little idle, which also follows them.
inline dsp::LogicTrace send(const Bytes& bytes, dsp::Hertz rate,
                            dsp::Seconds start = dsp::Seconds(0.01)) {
  dsp::LogicTrace line;
  dsp::Seconds t = start;
  for (const auto byte : bytes) t = send_byte(line, byte, t, rate);
  line.observe_until(t + 20 * dsp::period(rate));
  return line;
}

/// Every light pulse [fall, rise) of an idle-high line replaced by `bend(fall, rise)`.
template <class Bend>
dsp::LogicTrace bend_pulses(const dsp::LogicTrace& line, const Bend& bend) {
  dsp::LogicTrace bent(line.initial(), line.end());
  const auto edges = line.edges();
  for (std::size_t i = 0; i + 1 < edges.size(); i += 2) {
    const auto [fall, rise] = bend(edges[i], edges[i + 1]);
    bent.add_edge(fall);
    bent.add_edge(rise);
  }
  return bent;
}

inline Bytes values(const std::vector<UartByte>& received) {
  Bytes bytes;
  for (const auto& byte : received) bytes.push_back(byte.value);
  return bytes;
}

inline std::size_t framing_errors(const std::vector<UartByte>& received) {
  std::size_t count = 0;
  for (const auto& byte : received) count += byte.framing_error ? 1 : 0;
  return count;
}

/// Exactly these bytes came, with every stop bit right.
inline bool is_clean(const std::vector<UartByte>& received, const Bytes& sent) {
  return values(received) == sent && framing_errors(received) == 0;
}

}  // namespace protocol::test
