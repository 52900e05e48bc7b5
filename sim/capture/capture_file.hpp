#pragma once
// A capture by its file: a table of formats, a row each in capture_file.cpp, that says how one is
// recognised and opened. What is read streams, so a capture may be larger than memory, or a pipe
// where its format needs no seeking.
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/capture/logic_capture.hpp"
#include "sim/capture/sample_capture.hpp"
#include "sim/text/input_file.hpp"

namespace sim {

/// What the user says of a capture.
struct CaptureSettings {
  std::string wire;                       // or channel, or column; empty: the format's choice
  std::optional<dsp::Hertz> sample_rate;  // for formats that do not say it; overrides a file's own
  std::string format;                     // empty: by the file's ending, else by its first bytes
  std::optional<int> sample_bytes{};      // of raw files, 1 to 8; nothing: 1
  std::optional<dsp::Seconds> tick{};     // time unit of a file that does not say its own
};

/// One of the two is there: `samples` where the wanted channel is an analogue one.
struct Capture {
  std::unique_ptr<InputStream> in;
  std::unique_ptr<LogicCapture> logic;
  std::unique_ptr<SampleCapture> samples;
};

/// Throws Failure(bad_input) for what is no capture.
Capture open_capture(const std::filesystem::path& named, const CaptureSettings& settings);

/// The wire that was asked for; without one "rx", else the first.
std::size_t wanted_wire(const std::vector<std::string>& wires, const std::string& wanted,
                        const std::string& file);

std::vector<std::string> capture_format_names();

}  // namespace sim
