// `cosys-sim fit CAPTURE`: the constants of a receiver module, by what its output made of a plan's
// light.
#include <fmt/format.h>
#include <unistd.h>

#include <deque>
#include <vector>

#include "sim/command/commands.hpp"
#include "sim/command/reading_progress.hpp"
#include "sim/components/parts.hpp"
#include "sim/fit/bench_notes.hpp"
#include "sim/fit/captured_lines.hpp"
#include "sim/fit/drive_plan.hpp"
#include "sim/fit/fit_report.hpp"
#include "sim/fit/measured_part.hpp"
#include "sim/fit/plan_schedule.hpp"
#include "sim/fit/plan_text.hpp"
#include "sim/page/page.hpp"
#include "sim/text/escaped_text.hpp"
#include "sim/text/new_file.hpp"
#include "sim/text/shell_text.hpp"
#include "sim/text/standard_output.hpp"
#include "sim/text/text_file.hpp"

namespace sim {
namespace {

namespace fs = std::filesystem;

constexpr const char* parts_folder = "modules";  // where scenarios look for them
constexpr OwnFiles own_parts{is_measured_part, "a part of cosys-sim fit"};
constexpr OwnFiles own_pages{is_page, "a report of cosys-sim"};

/// What stands before the fit: the light, and what the module's output did.
struct LightAndOutput {
  Plan plan;
  std::string plan_words;
  std::optional<double> first_level_mw_per_m2;  // as the plan says
  std::string wire;
  PinRecording recording;
};

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
std::optional<fs::path> plan_place(const FitRequest& request) {
  if (!request.plan_file.empty()) return request.plan_file;
  const fs::path beside = request.captures.front().parent_path() / "plan.txt";
  std::error_code ignored;
  if (request.drive.empty() && fs::is_regular_file(beside, ignored)) return beside;
  return std::nullopt;
}

void read_plan_file(const fs::path& place, LightAndOutput& measurement) {
  constexpr std::size_t longest = 16 * mebibyte;
  const std::string text = read_text_file(place, "plan", longest);
  measurement.plan = plan_of_text(text, place.generic_string());
  measurement.plan_words = "the plan " + escaped_name(place.generic_string());
  if (is_written_plan_text(text)) measurement.first_level_mw_per_m2 = first_level_in(text);
}

void refuse_pipe_of_two(const fs::path& capture) {
  std::error_code ignored;
  if (capture == "-" || fs::is_fifo(capture, ignored))
    throw bad_input(capture.string(), "a plan is to be read out of it, and a pipe is read once",
                    "save it to a file, or say --plan PLAN");
}

/// Lines of the capture: all, where one has to be chosen.
std::vector<CapturedLine> wanted_lines(const FitRequest& request, bool has_plan,
                                       const ReadingListener& reached) {
  const bool is_all = !has_plan && request.drive.empty();
  return read_lines(request.captures.front(), capture_settings(request, is_all ? "" : request.wire),
                    reached);
}

LightAndOutput measurement_of(const FitRequest& request, const channel::ModuleData& like,
                              const ReadingListener& reached) {
  const fs::path& capture = request.captures.front();
  const std::optional<fs::path> place = plan_place(request);
  LightAndOutput measurement;
  if (place && request.carrier_hz)
    throw bad_input("--carrier with a plan", "the plan says its carriers", "leave it out");
  if (place)
    read_plan_file(*place, measurement);
  else
    refuse_pipe_of_two(capture);
  const WantedLines wanted{request.wire, request.drive, wanted_polarity(request)};
  const std::vector<CapturedLine> lines = wanted_lines(request, place.has_value(), reached);
  const CapturedLine& module = module_line(lines, wanted, capture.string());
  measurement.wire = module.name;
  measurement.recording = pin_recording(module, wanted.inverted, capture.string());
  if (place) return measurement;
  const std::string drive = drive_line(lines, wanted, module, capture.string());
  measurement.plan = plan_of_drive(capture, capture_settings(request, drive),
                                   request.carrier_hz.value_or(like.centre_hz), reached);
  measurement.plan_words = "the light on " + escaped_name(drive);
  return measurement;
}

LightAndOutput read_measurement(const FitRequest& request, const channel::ModuleData& like) {
  ReadingProgress progress("reading " + escaped_name(request.captures.front().string()),
                           !request.quiet);
  return measurement_of(request, like, [&](dsp::Seconds at) { progress.show(at); });
}

void refuse_places(const FitRequest& request) {
  if (request.output && request.output->extension() != ".toml")
    throw bad_input("--output " + request.output->string(), "a part's file ends in .toml",
                    "name a file, such as modules/mine.toml");
  const auto place_of = [](const fs::path& path) { return fs::absolute(path).lexically_normal(); };
  if (request.output && request.page && place_of(*request.output) == place_of(*request.page))
    throw bad_input("--page " + request.page->string(), "the part is to be written there",
                    "choose another name");
  if (request.output) refuse_to_lose(*request.output, own_parts);
  if (request.page) check_place(*request.page, own_pages);
}

/// Before the fit, which takes a while.
void prepare_part(const fs::path& place) {
  if (place.parent_path().filename() == parts_folder) make_folder(place.parent_path());
  check_place(place, own_parts);
}

MeasuredModule measured_module(const FitRequest& request, const channel::ModuleData& like,
                               LightAndOutput measurement) {
  MeasuredModule measured{.fit = {},
                          .plan = std::move(measurement.plan),
                          .like = like,
                          .capture = request.captures.front().filename().string(),
                          .wire = measurement.wire,
                          .plan_words = measurement.plan_words,
                          .first_level_by = {}};
  FitSettings settings;
  if (request.irradiance_mw_per_m2)
    measured.first_level_by = "--irradiance";
  else if (measurement.first_level_mw_per_m2)
    measured.first_level_by = measurement.plan_words;
  settings.first_level_mw_per_m2 =
      request.irradiance_mw_per_m2.value_or(measurement.first_level_mw_per_m2.value_or(0));
  measured.fit = fit_module(measured.plan, measurement.recording, like, settings);
  return measured;
}

/// All of them or none.
void write_measured(const FitRequest& request, const MeasuredModule& measured,
                    const Part<channel::ModuleData>& like) {
  std::deque<NewFile> files;
  if (request.output)
    files.emplace_back(*request.output)
        .write(measured_part_text(measured.fit, like, request.output->stem().string(),
                                  measured.capture));
  if (request.page) files.emplace_back(*request.page).write(page_as_html(measured_page(measured)));
  take_places(files);
}

/// What to do with the part's file.
std::string next_line(const FitRequest& request) {
  if (!request.output) return "Next: write the part with -o modules/mine.toml\n";
  const fs::path folder = request.output->parent_path();
  const std::string name = shell_word(request.output->stem().string());
  const bool is_found = folder.filename() == parts_folder;
  const fs::path root = is_found ? folder.parent_path() : folder;
  const std::string shown = root.empty() ? "." : root.string();
  const std::string run =
      fmt::format("cosys-sim run scenarios/quickstart.toml --parts {} --set receiver.module={}",
                  shell_word(shown), name);
  if (is_found) return "Next: " + run + "\n";
  return fmt::format("Next: put {} into a folder {}, then {}\n", request.output->string(),
                     (root / parts_folder).string(), run);
}

}  // namespace

ExitCode measure_command(const FitRequest& request) {
  const PartSources parts{.folders = request.parts, .carried = {}, .carrier = {}};
  const auto like = load_module(request.module, parts, "--module " + request.module);
  refuse_no_module(like.data);
  refuse_places(request);
  LightAndOutput measurement = read_measurement(request, like.data);
  if (request.output) prepare_part(*request.output);
  const MeasuredModule measured = measured_module(request, like.data, std::move(measurement));
  write_measured(request, measured, like);
  request.json ? print_json(measured_json(measured))
               : print(measured_text(measured) + next_line(request));
  return tells_something(measured) ? ExitCode::done : ExitCode::inconclusive;
}

}  // namespace sim
