#pragma once
// A capture read from its first edge to its last: its messages one by one, and what is known of its
// line then. `decode` prints one at length, or many as a table.
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "dsp/units.hpp"
#include "sim/capture/autobaud.hpp"
#include "sim/capture/capture_file.hpp"
#include "sim/capture/line_statistics.hpp"
#include "sim/command/commands.hpp"
#include "sim/trial/wire_protocols.hpp"

namespace sim {

struct DecodedCapture {
  std::string file;
  CaptureFacts read;
  LineFacts line;
  dsp::Hertz carrier{};  // 0: none
  // Of the whole capture, so that they are known at its end.
  std::optional<LineFit> fit;
  std::uint64_t characters = 0, framing_errors = 0;
  std::uint64_t accepted = 0, refused = 0;  // messages
};

/// Whom to tell meanwhile.
struct DecodeListener {
  std::function<void(const DecodedCapture&)> chosen;  // what is read and how, before all messages
  std::function<void(const WireFrame&)> message;
  std::function<void(dsp::Seconds)> reached;  // this instant of the capture, now and then
};

/// Whether several captures are asked for, or a folder.
bool asks_for_many(const DecodeRequest& request);

/// Throws Failure(bad_input) for what is no capture.
DecodedCapture decode_capture(const std::filesystem::path& path, const DecodeRequest& request,
                              const DecodeListener& listener);

/// What speaks against the reading, and what to say: another one is about as good, no line is
/// found, nothing is on the receiver's wire, or the unit of time may be another.
std::optional<std::string> doubt_about(const DecodedCapture& decoded);

/// What was read, in one line.
std::string reading_line(const DecodedCapture& decoded);

/// By how much the line's bit rate is above the one that it was read with; where there is a fit.
double baud_error_ppm(const DecodedCapture& decoded);

/// What was read, and what the line is like, as a line of JSON. Bytes of a file that are no UTF-8
/// are replaced, here and below.
std::string line_as_json(const DecodedCapture& decoded);

/// What became of one capture of many.
struct CaptureOutcome {
  DecodedCapture decoded;  // its file alone where it was not read
  std::string problem;     // why not, or what else it may be
  ExitCode code = ExitCode::done;

  bool was_read() const { return code == ExitCode::done || code == ExitCode::inconclusive; }
};

std::string outcome_as_json(const CaptureOutcome& outcome);

}  // namespace sim
