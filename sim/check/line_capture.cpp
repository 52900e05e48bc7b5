#include "sim/check/line_capture.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <sstream>
#include <vector>

#include "sim/trace/pulse_write.hpp"
#include "sim/trace/session_write.hpp"
#include "sim/trace/vcd.hpp"
#include "sim/trace/wav_image.hpp"

namespace sim {
namespace {

constexpr dsp::Hertz session_rate{200e3};
constexpr dsp::Hertz audio_rate{48e3};

/// `write(time in microseconds, level)` for the level at 0, each change, and the end.
template <class Write>
void for_each_level(const dsp::LogicTrace& wire, const Write& write) {
  bool level = wire.initial();
  write(0, level);
  for (const dsp::Seconds edge : wire.edges()) write(std::lround(edge.value * 1e6), level = !level);
  write(std::lround(wire.end().value * 1e6), level);
}

std::string to_edges(const DelimitedStream& line) {
  std::string text;
  for_each_level(line.wire, [&](long us, bool level) {
    fmt::format_to(std::back_inserter(text), "{} {:d}\n", us, level);
  });
  return text;
}

std::string to_csv(const DelimitedStream& line) {
  std::string text = "Time [s],rx\n";
  for_each_level(line.wire, [&](long us, bool level) {
    fmt::format_to(std::back_inserter(text), "{:.6f},{:d}\n", static_cast<double>(us) * 1e-6,
                   level);
  });
  return text;
}

std::string to_vcd(const DelimitedStream& line) {
  std::ostringstream out;
  const VcdWire rx{"rx", &line.wire};
  write_vcd(out, {&rx, 1}, line.wire.end());
  return out.str();
}

std::string to_pulses(const DelimitedStream& line) {
  std::ostringstream out;
  write_pulses(out, line.wire);
  return out.str();
}

std::string to_session(const DelimitedStream& line) {
  return wire_as_session(line.wire, session_rate);
}

/// What a serial port would have read by the scenario's own UART.
std::string to_bytes(const DelimitedStream& line) {
  std::string bytes;
  for (const protocol::UartByte& byte : line.uart->receive(line.wire, line.baud, 0))
    bytes += static_cast<char>(byte.value);
  return bytes;
}

std::vector<short> audio_of(const dsp::LogicTrace& wire) {
  constexpr short high = 16384;
  dsp::TraceReader reader(wire);
  std::vector<short> samples(static_cast<std::size_t>(dsp::cycles(wire.end(), audio_rate)));
  for (std::size_t i = 0; i < samples.size(); ++i)
    samples[i] = reader.level_at(dsp::Seconds(static_cast<double>(i) / audio_rate.value))
                     ? high
                     : short{-high};
  return samples;
}

/// The wire's voltage, as a sound card without a coupling capacitor hears it: half of full scale is
/// 1, minus half of it 0.
std::string to_wav(const DelimitedStream& line) {
  return wav_image(audio_of(line.wire), audio_rate);
}

constexpr LineCapture formats[] = {
    {"vcd", ".vcd", to_vcd}, {"sr", ".sr", to_session},   {"edges", ".edges", to_edges},
    {"csv", ".csv", to_csv}, {"bytes", ".bin", to_bytes}, {"ook", ".ook", to_pulses},
    {"wav", ".wav", to_wav},
};

}  // namespace

std::span<const LineCapture> line_captures() { return formats; }

}  // namespace sim
