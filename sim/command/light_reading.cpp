#include "sim/command/light_reading.hpp"

#include <fmt/format.h>

#include <utility>

#include "sim/command/reading_progress.hpp"
#include "sim/fit/bench_notes.hpp"
#include "sim/fit/captured_lines.hpp"
#include "sim/fit/drive_plan.hpp"
#include "sim/fit/message_plan.hpp"
#include "sim/text/escaped_text.hpp"
#include "sim/text/text_file.hpp"

namespace sim {
namespace {

namespace fs = std::filesystem;

std::optional<dsp::Hertz> rate_of(const std::optional<double>& rate) {
  return rate ? std::optional(dsp::Hertz(*rate)) : std::nullopt;
}

CaptureSettings capture_settings(const FitRequest& request, const std::string& wire) {
  return {.wire = wire,
          .sample_rate = rate_of(request.sample_rate_hz),
          .format = request.format,
          .sample_bytes = request.sample_bytes,
          .tick = request.tick,
          .skip_rows = request.skip_rows};
}

std::optional<bool> wanted_polarity(const FitRequest& request) {
  if (request.polarity == "auto") return std::nullopt;
  return request.polarity == "idle-low";
}

/// The plan that was named, or the one beside the capture; nothing where the capture is to tell it.
std::optional<fs::path> plan_place(const FitRequest& request, std::size_t which) {
  const auto& named = request.plan_files;
  if (!named.empty()) return named[named.size() == 1 ? 0 : which];
  const fs::path beside = request.captures[which].parent_path() / "plan.txt";
  std::error_code ignored;
  if (request.drive.empty() && fs::is_regular_file(beside, ignored)) return beside;
  return std::nullopt;
}

void read_plan_file(const fs::path& place, LightReading& reading) {
  constexpr std::size_t longest = 16 * mebibyte;
  const std::string text = read_text_file(place, "plan", longest);
  reading.plan = plan_of_text(text, place.generic_string());
  reading.plan_words = "the plan " + escaped_name(place.generic_string());
  if (!is_written_plan_text(text)) return;
  reading.first_level_mw_per_m2 = first_level_in(text);
  if (const auto level = reading.first_level_mw_per_m2; level && !(*level > 0 && *level < 1e9))
    throw bad_input(fmt::format("first level: {:g} in {}", *level, place.generic_string()),
                    "it is no irradiance", "give mW/m2 above 0, or delete the line");
}

void refuse_pipe_of_two(const fs::path& capture) {
  std::error_code ignored;
  if (capture == "-" || fs::is_fifo(capture, ignored))
    throw bad_input(capture.string(), "a plan is to be read out of it, and a pipe is read once",
                    "save it to a file, or say --plan PLAN");
}

void refuse_what_a_plan_says(const FitRequest& request) {
  for (const auto& [is_given, option] : {std::pair{request.carrier_hz.has_value(), "--carrier"},
                                         {request.baud.has_value(), "--baud"},
                                         {!request.message.empty(), "--message"}})
    if (is_given)
      throw bad_input(fmt::format("{} with a plan", option), "the plan says what the light was",
                      "leave it out");
}

/// Where nothing but the module's output says what the light was.
void read_messages(const FitRequest& request, const fs::path& capture, LightReading& reading) {
  MessageLight light;
  if (request.carrier_hz) light.carrier_hz = *request.carrier_hz;
  if (request.baud) light.baud = *request.baud;
  light.message = request.message;
  MessagePlan found = plan_of_messages(reading.recording, light, capture.string());
  reading.plan = std::move(found.plan);
  reading.plan_words =
      fmt::format("the message {} at {:g} Bd, {} times, {} of them whole",
                  escaped_name(found.message), light.baud, found.messages, found.whole);
  reading.is_of_messages = true;
}

/// Lines of the capture: all, where one has to be chosen.
std::vector<CapturedLine> wanted_lines(const fs::path& capture, const FitRequest& request,
                                       bool has_plan, const ReadingListener& reached) {
  const bool is_all = !has_plan && request.drive.empty();
  return read_lines(capture, capture_settings(request, is_all ? "" : request.wire), reached);
}

LightReading reading_of(const FitRequest& request, std::size_t which,
                        const channel::ModuleData& like, const ReadingListener& reached) {
  const fs::path& capture = request.captures[which];
  const std::optional<fs::path> place = plan_place(request, which);
  LightReading reading;
  if (place) refuse_what_a_plan_says(request);
  if (place) read_plan_file(*place, reading);
  const WantedLines wanted{request.wire, request.drive, wanted_polarity(request)};
  const std::vector<CapturedLine> lines =
      wanted_lines(capture, request, place.has_value(), reached);
  const CapturedLine& module = module_line(lines, wanted, capture.string());
  reading.wire = module.name;
  reading.recording = pin_recording(module, wanted.inverted, capture.string());
  if (place) return reading;
  if (lines.size() == 1 && request.drive.empty()) {
    read_messages(request, capture, reading);
    return reading;
  }
  refuse_pipe_of_two(capture);
  const std::string drive = drive_line(lines, wanted, module, capture.string());
  reading.plan = plan_of_drive(capture, capture_settings(request, drive),
                               request.carrier_hz.value_or(like.centre_hz), reached);
  reading.plan_words = "the light on " + escaped_name(drive);
  reading.is_of_drive = true;
  return reading;
}

}  // namespace

LightReading read_light(const FitRequest& request, std::size_t which,
                        const channel::ModuleData& like) {
  ReadingProgress progress("reading " + escaped_name(request.captures[which].string()),
                           !request.quiet);
  return reading_of(request, which, like, [&](dsp::Seconds at) { progress.show(at); });
}

}  // namespace sim
