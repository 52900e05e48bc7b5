#include "sim/check/line_capture.hpp"

#include <fmt/format.h>
#include <sndfile.h>

#include <cmath>
#include <iterator>
#include <sstream>
#include <vector>

#include "sim/failure.hpp"
#include "sim/trace/pulse_write.hpp"
#include "sim/trace/session_write.hpp"
#include "sim/trace/vcd.hpp"

namespace sim {
namespace {

constexpr dsp::Hertz session_rate{200e3};
constexpr int audio_rate = 48000;

/// `write(time in microseconds, level)` for the level at 0, each change, and the end.
template <class Write>
void for_each_level(const dsp::LogicTrace& wire, const Write& write) {
  bool level = wire.initial();
  write(0, level);
  for (const dsp::Seconds flip : wire.flips()) write(std::lround(flip.value * 1e6), level = !level);
  write(std::lround(wire.end().value * 1e6), level);
}

std::string to_edges(const MarkedLine& line) {
  std::string text;
  for_each_level(line.wire, [&](long us, bool level) {
    fmt::format_to(std::back_inserter(text), "{} {:d}\n", us, level);
  });
  return text;
}

std::string to_csv(const MarkedLine& line) {
  std::string text = "Time [s],rx\n";
  for_each_level(line.wire, [&](long us, bool level) {
    fmt::format_to(std::back_inserter(text), "{:.6f},{:d}\n", static_cast<double>(us) * 1e-6,
                   level);
  });
  return text;
}

std::string to_vcd(const MarkedLine& line) {
  std::ostringstream out;
  const VcdWire rx{"rx", &line.wire};
  write_vcd(out, {&rx, 1}, line.wire.end());
  return out.str();
}

std::string to_pulses(const MarkedLine& line) {
  std::ostringstream out;
  write_pulses(out, line.wire);
  return out.str();
}

std::string to_session(const MarkedLine& line) { return wire_as_session(line.wire, session_rate); }

/// What a serial port would have read by the scenario's own UART.
std::string to_bytes(const MarkedLine& line) {
  std::string bytes;
  for (const protocol::UartByte& byte : line.uart->receive(line.wire, line.baud, 0))
    bytes += static_cast<char>(byte.value);
  return bytes;
}

/// A file in memory, as libsndfile writes one.
struct MemoryFile {
  std::string bytes;
  std::size_t at = 0;

  static MemoryFile& of(void* self) { return *static_cast<MemoryFile*>(self); }
  static sf_count_t size(void* self) { return static_cast<sf_count_t>(of(self).bytes.size()); }
  static sf_count_t tell(void* self) { return static_cast<sf_count_t>(of(self).at); }
  static sf_count_t seek(sf_count_t offset, int whence, void* self) {
    const sf_count_t from = whence == SEEK_SET ? 0 : whence == SEEK_CUR ? tell(self) : size(self);
    of(self).at = static_cast<std::size_t>(from + offset);
    return tell(self);
  }
  static sf_count_t write(const void* from, sf_count_t count, void* self) {
    MemoryFile& file = of(self);
    const auto n = static_cast<std::size_t>(count);
    if (file.bytes.size() < file.at + n) file.bytes.resize(file.at + n);
    file.bytes.replace(file.at, n, static_cast<const char*>(from), n);
    file.at += n;
    return count;
  }
  static sf_count_t read(void*, sf_count_t, void*) { return 0; }
};

std::vector<short> audio_of(const dsp::LogicTrace& wire) {
  constexpr short high = 16384;
  dsp::TraceReader reader(wire);
  std::vector<short> samples(static_cast<std::size_t>(wire.end().value * audio_rate));
  for (std::size_t i = 0; i < samples.size(); ++i)
    samples[i] =
        reader.level_at(dsp::Seconds(static_cast<double>(i) / audio_rate)) ? high : short{-high};
  return samples;
}

/// The wire's voltage, as a sound card without a coupling capacitor hears it: half of full scale is
/// 1, minus half of it 0.
std::string to_wav(const MarkedLine& line) {
  MemoryFile file;
  SF_VIRTUAL_IO io{MemoryFile::size, MemoryFile::seek, MemoryFile::read, MemoryFile::write,
                   MemoryFile::tell};
  SF_INFO info{};
  info.samplerate = audio_rate;
  info.channels = 1;
  info.format = SF_FORMAT_WAV | SF_FORMAT_PCM_16;
  SNDFILE* wav = sf_open_virtual(&io, SFM_WRITE, &info, &file);
  if (wav == nullptr) throw Failure(ExitCode::environment, "libsndfile cannot write WAV");
  const std::vector<short> samples = audio_of(line.wire);
  sf_write_short(wav, samples.data(), static_cast<sf_count_t>(samples.size()));
  sf_close(wav);
  return file.bytes;
}

constexpr LineCapture formats[] = {
    {"vcd", ".vcd", to_vcd}, {"sr", ".sr", to_session},   {"edges", ".edges", to_edges},
    {"csv", ".csv", to_csv}, {"bytes", ".bin", to_bytes}, {"ook", ".ook", to_pulses},
    {"wav", ".wav", to_wav},
};

}  // namespace

std::span<const LineCapture> line_captures() { return formats; }

}  // namespace sim
