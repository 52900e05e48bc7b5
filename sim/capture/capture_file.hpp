#pragma once
// A capture by its file: a table of formats, a row each in capture_file.cpp, that says how one is
// recognised and opened. What is read streams, so a capture may be larger than memory, or a pipe
// where its format needs no seeking.
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/capture/logic_capture.hpp"
#include "sim/capture/sample_capture.hpp"
#include "sim/capture/wire_choice.hpp"
#include "sim/text/input_file.hpp"

namespace sim {

/// What the user says of a capture.
struct CaptureSettings {
  std::string wire;                       // or channel, or column; empty: the format's choice
  std::optional<dsp::Hertz> sample_rate;  // for files that do not say it
  std::string format;                     // empty: by the file's ending, else by its first bytes
  std::optional<int> sample_bytes{};      // of raw files, 1 to 8; nothing: 1
  std::optional<dsp::Seconds> tick{};     // unit of time, for files that do not say it
  std::size_t skip_rows = 0;              // lines of a table that are passed over
  LineHints hints{};                      // by which a wire is chosen
  bool is_one_of_many = false;            // the same is said of other files too

  /// What holds where a file says `own` of itself. What is told of one file holds over that; of
  /// many files it is meant for those that say nothing.
  std::optional<dsp::Hertz> rate_over(std::optional<dsp::Hertz> own) const {
    return own && (is_one_of_many || !sample_rate) ? own : sample_rate;
  }
  std::optional<dsp::Seconds> tick_over(std::optional<dsp::Seconds> own) const {
    return own && (is_one_of_many || !tick) ? own : tick;
  }
};

/// What was read, and how: to be said to the user.
struct CaptureFacts {
  struct Channel {
    std::string name;
    std::optional<std::uint64_t> edges;  // nothing: they were not counted
  };

  std::string format;
  std::vector<Channel> channels;
  std::optional<std::size_t> taken;  // of the channels, the one that is read
  bool is_whole = true;              // edges are those of the whole capture, not of its beginning
  std::string time;                  // how instants are told; empty: as the format says
  bool is_tick_assumed = false;      // the unit of time is in none of its words
  std::vector<std::string> assumed;
  std::optional<std::size_t> rival;  // another channel that reads as well
  std::optional<std::string> doubt;  // what else the file may be, and how to say so
};

/// Takes the best of these channels. Its place among them.
std::size_t take_choice(std::span<const ChannelSurvey> surveys, CaptureFacts& facts);

/// One of the two is there: `samples` where the wanted channel is an analogue one.
struct Capture {
  std::unique_ptr<InputStream> in;
  std::unique_ptr<LogicCapture> logic;
  std::size_t wire = 0;  // of `logic`: the one to read
  std::unique_ptr<SampleCapture> samples;
  CaptureFacts facts;
};

/// Throws Failure(bad_input) for what is no capture.
Capture open_capture(const std::filesystem::path& named, const CaptureSettings& settings);

std::vector<std::string> capture_format_names();

/// Whether a file of a folder is taken for a capture by its ending. A .sigmf-data is not: its
/// .sigmf-meta stands for both.
bool has_capture_ending(const std::filesystem::path& path);

}  // namespace sim
