#pragma once
// Random lines for the tests of captures. Everything is a function of its seed.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <sstream>
#include <string>

#include "dsp/logic_trace.hpp"
#include "protocol/cosys.hpp"
#include "protocol/uart.hpp"
#include "sim/failure.hpp"

namespace sim::test {

using Random = std::mt19937_64;

inline double uniform(Random& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11U) * 0x1p-53;
}

/// About a normal deviate: the sum of twelve uniform ones.
inline double normal(Random& random) {
  double sum = -6;
  for (int i = 0; i < 12; ++i) sum += uniform(random, 0, 1);
  return sum;
}

/// Edges on a grid of whole microseconds, after 0 and before the end.
inline dsp::LogicTrace random_trace(Random& random, bool initial, std::size_t edges) {
  dsp::LogicTrace trace(initial);
  double at_us = 0;
  for (std::size_t i = 0; i < edges; ++i) {
    at_us += 1 + static_cast<double>(random() % 1000);
    trace.add_edge(dsp::Seconds(at_us * 1e-6));
  }
  trace.observe_until(dsp::Seconds((at_us + 10) * 1e-6));
  return trace;
}

inline std::vector<long> edges_us(const dsp::LogicTrace& trace) {
  std::vector<long> times;
  for (const dsp::Seconds edge : trace.edges()) times.push_back(std::lround(edge.value * 1e6));
  return times;
}

inline protocol::Bytes random_message(Random& random) {
  std::string text = "IND ";
  for (auto n = 4 + random() % 12; n > 0; --n) text += static_cast<char>(' ' + random() % 95);
  return protocol::cosys_encode(text);
}

/// Messages with pauses; each light pulse ends `distortion` too late, and each edge is off by a
/// normal deviate of `jitter`.
struct LineFaults {
  double distortion_s = 0, jitter_s = 0;
};

inline dsp::LogicTrace bent_line(Random& random, int messages, double baud, LineFaults faults) {
  dsp::LogicTrace sent;
  dsp::Seconds at(30 / baud);
  for (int i = 0; i < messages; ++i) {
    for (const std::uint8_t byte : random_message(random)) {
      at = protocol::send_byte(sent, byte, at, dsp::Hertz(baud));
      if (random() % 4 == 0) at += dsp::Seconds(uniform(random, 0.4, 1.2) / baud);
    }
    at += dsp::Seconds(uniform(random, 20, 60) / baud);
  }
  dsp::LogicTrace bent;
  bool rising = false;
  for (const dsp::Seconds edge : sent.edges()) {
    const double shift = (rising ? faults.distortion_s : 0) + faults.jitter_s * normal(random);
    bent.add_edge(std::max(bent.end(), edge + dsp::Seconds(shift)));
    rising = !rising;
  }
  bent.observe_until(at);
  return bent;
}

template <class Read>
std::string failure_of(const Read& read) {
  try {
    read();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::bad_input) << failure.what();
    EXPECT_EQ(std::string(failure.what()).find('\n'), std::string::npos) << failure.what();
    return failure.what();
  }
  return "no failure";
}

}  // namespace sim::test
