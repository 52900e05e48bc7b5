#pragma once
// The lines of a capture, of whatever format, each with its changes; and which of them is the
// module's output, and which drives the LED.
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/capture/capture_file.hpp"
#include "sim/fit/pin_recording.hpp"

namespace sim {

/// A wire, or a channel of samples as the level that it has. Of one that carries a carrier it is
/// low in bursts, and high between them.
struct CapturedLine {
  std::string name;
  bool initial = true;
  std::vector<double> edges_s;
  double end_s = 0;         // it was watched until then
  double resolution_s = 0;  // between two samples; 0 where edges are exact
  double carrier_hz = 0;    // 0: none
  bool is_sampled = false;  // voltages or light, not levels

  /// Whether it is high for most of the time.
  bool idles_high() const;
};

/// Called with an instant of the capture, now and then.
using ReadingListener = std::function<void(dsp::Seconds)>;

/// The one that the settings name, or all that have edges. Throws Failure(bad_input) for what is no
/// capture, and for a pipe that has several.
std::vector<CapturedLine> read_lines(const std::filesystem::path& path,
                                     const CaptureSettings& settings,
                                     const ReadingListener& reached);

/// What was said of the capture's lines.
struct WantedLines {
  std::string module{}, drive{};   // names; empty: not said
  std::optional<bool> inverted{};  // the module's output; nothing: by how it idles
};

/// The module's output: the one that was named, or called rx, or the only one that can be it.
/// Throws Failure(bad_input) where none or several can; `file` names the capture.
const CapturedLine& module_line(const std::vector<CapturedLine>& lines, const WantedLines& wanted,
                                const std::string& file);

/// The name of the line that drives the LED: the one that was named, or the only other one of at
/// least two lines. Throws likewise.
std::string drive_line(const std::vector<CapturedLine>& lines, const WantedLines& wanted,
                       const CapturedLine& module, const std::string& file);

/// The module's output as the spells in which it reports light. Throws Failure(bad_input) for what
/// is no module's output.
PinRecording pin_recording(const CapturedLine& module, std::optional<bool> inverted,
                           const std::string& file);

}  // namespace sim
