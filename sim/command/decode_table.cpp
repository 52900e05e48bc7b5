#include "sim/command/decode_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "sim/columns/text_table.hpp"
#include "sim/command/decoded_capture.hpp"
#include "sim/command/reading_progress.hpp"
#include "sim/text/escaped_text.hpp"
#include "sim/text/letters.hpp"
#include "sim/text/standard_output.hpp"

namespace sim {
namespace {

namespace fs = std::filesystem;

/// A capture, or a folder that cannot be read, and why.
struct Place {
  fs::path path;
  std::string problem;
};

/// Those of a folder and of the folders in it, by their names. Links to folders are not followed.
void add_places(const fs::path& folder, std::vector<Place>& places) {
  std::error_code error;
  std::vector<fs::path> inside;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    inside.push_back(entry->path());
  if (error)
    places.push_back(
        {folder, fmt::format("cannot read the folder ({}) see its permissions", error.message())});
  std::ranges::sort(inside);
  for (const fs::path& path : inside) {
    std::error_code ignored;
    if (fs::is_directory(fs::symlink_status(path, ignored)))
      add_places(path, places);
    else if (has_capture_ending(path))
      places.push_back({path, ""});
  }
}

std::vector<Place> all_places(const std::vector<fs::path>& named) {
  std::vector<Place> places;
  for (const fs::path& path : named) {
    const std::size_t before = places.size();
    std::error_code ignored;
    if (!fs::is_directory(path, ignored))
      places.push_back({path, ""});
    else
      add_places(path, places);
    if (places.size() == before)
      throw bad_input("no capture in " + path.string(), "no file there has the ending of one",
                      "name the files");
  }
  return places;
}

CaptureOutcome outcome_of(const Place& place, const DecodeRequest& request,
                          ReadingProgress& progress) {
  CaptureOutcome outcome;
  outcome.decoded.file = place.path.string();
  if (!place.problem.empty()) {
    outcome.problem = place.problem;
    outcome.code = ExitCode::environment;
    return outcome;
  }
  const DecodeListener listener{[](const DecodedCapture&) {}, [](const WireFrame&) {},
                                [&](dsp::Seconds at) { progress.show(at); }};
  try {
    outcome.decoded = decode_capture(place.path, request, listener);
    if (const auto doubt = doubt_about(outcome.decoded)) {
      outcome.problem = *doubt;
      outcome.code = ExitCode::inconclusive;
    }
  } catch (const Failure& failure) {
    outcome.problem = failure.what();
    outcome.code = failure.code();
  } catch (const std::exception& error) {  // a file that needs more memory than there is
    outcome.problem = error.what();
    outcome.code = ExitCode::environment;
  }
  return outcome;
}

std::vector<TextColumn> capture_columns(const std::vector<Place>& places) {
  std::size_t longest = 7;
  for (const Place& place : places)
    longest = std::max(longest, letters_in(escaped_name(place.path.string())));
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
  if (!row.was_read()) {
    const std::string name = table_line({table.front()}, {escaped_name(decoded.file)});
    return name.substr(0, name.size() - 1) + "  " + row.problem + "\n";
  }
  std::string line = table_line(
      table, {escaped_name(decoded.file), decoded.read.format,
              shortened(escaped_name(decoded.read.channels[*decoded.read.taken].name), 12),
              decoded.line.inverted ? "idle-low" : "idle-high",
              fmt::format("{:.6g}", decoded.line.baud.value), std::to_string(decoded.characters),
              std::to_string(decoded.framing_errors), std::to_string(decoded.accepted),
              std::to_string(decoded.refused)});
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
  const std::vector<Place> places = all_places(request.captures);
  const std::vector<TextColumn> table = capture_columns(places);
  if (!request.json) print(table_head(table));
  ExitCode code = ExitCode::done;
  std::size_t unread = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    ReadingProgress progress(fmt::format("capture {} of {}", i + 1, places.size()), true);
    const CaptureOutcome outcome = outcome_of(places[i], request, progress);
    progress.clear();
    request.json ? print_json(outcome_as_json(outcome)) : print(row_text(outcome, table));
    code = worse_of(code, outcome.code);
    unread += outcome.was_read() ? 0 : 1;
  }
  if (unread > 0)
    say(fmt::format("cosys-sim: {} of {} captures could not be read\n", unread, places.size()));
  return code;
}

}  // namespace sim
