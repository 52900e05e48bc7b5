#include "sim/command/decode_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "sim/command/decoded_capture.hpp"
#include "sim/command/reading_progress.hpp"
#include "sim/report/text_table.hpp"
#include "sim/text/escaped_text.hpp"
#include "sim/text/letters.hpp"
#include "sim/text/standard_output.hpp"

namespace sim {
namespace {

namespace fs = std::filesystem;

bool is_capture_by_name(const fs::path& path) {
  const std::string name = in_lower_case(path.filename().string());
  return std::ranges::any_of(capture_format_names(), [&](const std::string& format) {
    return format != "sigmf-data" && name.ends_with("." + format);  // its .sigmf-meta is read
  });
}

std::vector<fs::path> captures_in(const fs::path& folder) {
  std::vector<fs::path> found;
  try {
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      if (entry.is_regular_file() && is_capture_by_name(entry.path()))
        found.push_back(entry.path());
  } catch (const fs::filesystem_error& error) {
    throw Failure(
        ExitCode::environment,
        fmt::format("{} ({}) see its permissions", error.path1().string(), error.code().message()));
  }
  if (found.empty())
    throw bad_input(
        "no capture in " + folder.string(),
        fmt::format("no file there ends in .{}", fmt::join(capture_format_names(), ", .")),
        "name the files");
  std::ranges::sort(found);
  return found;
}

std::vector<fs::path> all_captures(const std::vector<fs::path>& named) {
  std::vector<fs::path> all;
  for (const fs::path& path : named) {
    if (!fs::is_directory(path)) {
      all.push_back(path);
      continue;
    }
    const std::vector<fs::path> found = captures_in(path);
    all.insert(all.end(), found.begin(), found.end());
  }
  return all;
}

CaptureOutcome outcome_of(const fs::path& path, const DecodeRequest& request,
                          ReadingProgress& progress) {
  CaptureOutcome outcome;
  outcome.decoded.file = path.string();
  const DecodeListener listener{[](const DecodedCapture&) {}, [](const WireFrame&) {},
                                [&](dsp::Seconds at) { progress.show(at); }};
  try {
    outcome.decoded = decode_capture(path, request, listener);
    if (const auto doubt = doubt_about(outcome.decoded)) {
      outcome.problem = *doubt;
      outcome.code = ExitCode::inconclusive;
    }
  } catch (const Failure& failure) {
    outcome.problem = failure.what();
    outcome.code = failure.code();
  }
  return outcome;
}

std::vector<TextColumn> capture_columns(const std::vector<fs::path>& captures) {
  std::size_t longest = 7;
  for (const fs::path& path : captures)
    longest = std::max(longest, letters_in(escaped(path.string())));
  return {{{"", "", "capture"}, -static_cast<int>(longest)},
          {{"", "", "format"}, -10},
          {{"", "", "channel"}, -12},
          {{"", "", "polarity"}, -9},
          {{"", "", "Bd"}, number_width},
          {{"", "", "characters"}, 10},
          {{"", "framing", "errors"}, 7},
          {{"", "messages", "accepted"}, 8},
          {{"", "", "refused"}, 7}};
}

std::string row_text(const CaptureOutcome& row, const std::vector<TextColumn>& table) {
  const DecodedCapture& decoded = row.decoded;
  if (!row.was_read()) return fmt::format("{}  {}\n", escaped(decoded.file), row.problem);
  std::string line =
      table_line(table, {escaped(decoded.file), decoded.read.format,
                         shortened(escaped(decoded.read.channels[*decoded.read.taken].name), 12),
                         decoded.line.inverted ? "idle-low" : "idle-high",
                         fmt::format("{:.6g}", decoded.line.baud.value),
                         std::to_string(decoded.characters), std::to_string(decoded.framing_errors),
                         std::to_string(decoded.accepted), std::to_string(decoded.refused)});
  if (row.code != ExitCode::done) line += "  " + row.problem + "\n";
  return line;
}

/// Of two: a machine that fails, then what is no capture, then what is left open.
ExitCode worse_of(ExitCode a, ExitCode b) {
  for (const ExitCode code : {ExitCode::environment, ExitCode::bad_input, ExitCode::inconclusive})
    if (a == code || b == code) return code;
  return ExitCode::done;
}

}  // namespace

ExitCode decode_table(const DecodeRequest& request) {
  const std::vector<fs::path> captures = all_captures(request.captures);
  const std::vector<TextColumn> table = capture_columns(captures);
  if (!request.json) print(table_head(table));
  ExitCode code = ExitCode::done;
  for (std::size_t i = 0; i < captures.size(); ++i) {
    ReadingProgress progress(fmt::format("capture {} of {}", i + 1, captures.size()), true);
    const CaptureOutcome outcome = outcome_of(captures[i], request, progress);
    progress.clear();
    print(request.json ? outcome_as_json(outcome) : row_text(outcome, table));
    code = worse_of(code, outcome.code);
  }
  return code;
}

}  // namespace sim
