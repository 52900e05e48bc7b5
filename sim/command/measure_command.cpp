// `cosys-sim fit CAPTURE`: the constants of a receiver module, by what its output made of a plan's
// light.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <deque>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "sim/command/commands.hpp"
#include "sim/command/light_reading.hpp"
#include "sim/components/parts.hpp"
#include "sim/fit/fit_report.hpp"
#include "sim/fit/fit_words.hpp"
#include "sim/fit/fitted_module.hpp"
#include "sim/fit/measured_part.hpp"
#include "sim/fit/plan_schedule.hpp"
#include "sim/page/page.hpp"
#include "sim/text/existing_file.hpp"
#include "sim/text/new_file.hpp"
#include "sim/text/shell_text.hpp"
#include "sim/text/standard_output.hpp"

namespace sim {
namespace {

namespace fs = std::filesystem;

constexpr const char* parts_folder = "modules";  // where scenarios look for them
constexpr OwnFiles own_parts{is_measured_part, "a part of cosys-sim fit"};
constexpr OwnFiles own_pages{is_page, "a report of cosys-sim"};

void refuse_places(const FitRequest& request) {
  if (request.output && request.output->extension() != ".toml")
    throw bad_input("--output " + request.output->string(), "a part's file ends in .toml",
                    "name a file, such as modules/mine.toml");
  const auto place_of = [](const fs::path& path) { return fs::absolute(path).lexically_normal(); };
  if (request.output && request.page && place_of(*request.output) == place_of(*request.page))
    throw bad_input("--page " + request.page->string(), "the part is to be written there",
                    "choose another name");
  if (request.page && request.page->extension() == ".toml")
    throw bad_input("--page " + request.page->string(), "a page is HTML",
                    "name a file, such as mine.html");
  if (request.output) refuse_to_lose(*request.output, own_parts);
  if (request.page) check_place(*request.page, own_pages);
}

void refuse_plans(const std::vector<fs::path>& captures) {
  constexpr std::size_t first_line = 80;
  std::error_code ignored;
  for (const fs::path& capture : captures)
    if (fs::is_regular_file(capture, ignored) &&
        is_written_plan_text(beginning_of(capture, first_line)))
      throw bad_input(capture.string(), "it is a plan, not a recording",
                      "write cosys-sim fit CAPTURE --plan " + capture.string());
}

/// It would count as another recording, and make all intervals shorter.
void refuse_one_twice(const std::vector<fs::path>& captures) {
  std::error_code ignored;
  for (std::size_t k = 0; k < captures.size(); ++k)
    for (std::size_t i = 0; i < k; ++i)
      if (fs::equivalent(captures[i], captures[k], ignored))
        throw bad_input(captures[k].string(), "it is named twice", "name each capture once");
}

/// Before the fit, which takes a while.
void prepare_part(const fs::path& place) {
  if (place.parent_path().filename() == parts_folder) make_folder(place.parent_path());
  check_place(place, own_parts);
}

/// Of the capture at a place: as --irradiance says, of the first one also as its plan does.
std::optional<double> first_level_of(const FitRequest& request, const LightReading& reading,
                                     std::size_t which) {
  if (which < request.irradiances_mw_per_m2.size()) return request.irradiances_mw_per_m2[which];
  return which == 0 ? reading.first_level_mw_per_m2 : std::nullopt;
}

/// Names of the files; with their folders, where some are called alike.
std::vector<std::string> names_of_files(const std::vector<fs::path>& captures) {
  std::vector<std::string> names;
  for (const fs::path& capture : captures) names.push_back(capture.filename().string());
  const std::set<std::string> distinct(names.begin(), names.end());
  if (distinct.size() < names.size())
    std::ranges::transform(captures, names.begin(), [](const fs::path& p) { return p.string(); });
  return names;
}

/// As the last line says of what the sketch sent (sim/fit/bench_sketch.ino). A pipe was read
/// already.
std::uint64_t lost_pairs_in(const fs::path& capture) {
  static constexpr std::string_view word = "# pairs of edges lost: ";
  constexpr std::streamoff last_line = 64;
  if (!fs::is_regular_file(capture)) return 0;
  std::ifstream file(capture, std::ios::binary | std::ios::ate);
  file.seekg(std::max<std::streamoff>(file.tellg() - last_line, 0));
  const std::string end(std::istreambuf_iterator<char>(file), {});
  const std::size_t place = end.rfind(word);
  return place == std::string::npos ? 0
                                    : std::strtoull(end.c_str() + place + word.size(), nullptr, 10);
}

MeasuredModule measured_module(const FitRequest& request, const channel::ModuleData& like,
                               std::vector<LightReading> readings) {
  MeasuredModule measured{.fit = {}, .like = like, .captures = {}, .first_level_by = {}};
  const std::optional<double> first_level = first_level_of(request, readings.front(), 0);
  measured.first_level_mw_per_m2 = first_level.value_or(0);
  if (first_level)
    measured.first_level_by =
        request.irradiances_mw_per_m2.empty() ? readings.front().plan_words : "--irradiance";
  measured.is_first_level_measured = !request.irradiances_mw_per_m2.empty();
  const std::vector<std::string> files = names_of_files(request.captures);
  std::vector<LightCapture> captures;
  for (std::size_t k = 0; k < readings.size(); ++k) {
    LightReading& reading = readings[k];
    const std::optional<double> level = first_level_of(request, reading, k);
    const double ambient = request.ambients_w_per_m2.empty() ? 0 : request.ambients_w_per_m2[k];
    measured.captures.push_back({.file = files[k],
                                 .wire = reading.wire,
                                 .plan_words = reading.plan_words,
                                 .steps = reading.plan.steps.size(),
                                 .ambient_w_per_m2 = ambient,
                                 .is_of_messages = reading.is_of_messages,
                                 .is_of_drive = reading.is_of_drive,
                                 .is_of_known_level = level.has_value(),
                                 .lost_pairs = lost_pairs_in(request.captures[k])});
    captures.push_back({std::move(reading.plan), std::move(reading.recording), level, ambient});
  }
  measured.fit = fit_module(captures, like);
  return measured;
}

/// All of them or none; no part that has no number of its own.
void write_measured(const FitRequest& request, const MeasuredModule& measured,
                    const Part<channel::ModuleData>& like) {
  std::deque<NewFile> files;
  if (request.output && tells_something(measured))
    files.emplace_back(*request.output)
        .write(measured_part_text(measured.fit, like, request.output->stem().string(),
                                  files_in_words(measured.captures), level_sentence(measured)));
  if (request.page) files.emplace_back(*request.page).write(page_as_html(measured_page(measured)));
  take_places(files);
}

/// The scenario to begin with: the one that is here, else the one that comes with the program.
std::string quickstart_place(const FitRequest& request) {
  const fs::path here = "scenarios/quickstart.toml";
  std::error_code ignored;
  if (fs::is_regular_file(here, ignored)) return here.string();
  for (const fs::path& folder : request.parts)
    if (const fs::path shipped = folder / here.filename(); fs::is_regular_file(shipped, ignored))
      return shipped.string();
  return here.string();
}

/// What to do with the part's file.
std::string next_line(const FitRequest& request, const MeasuredModule& measured) {
  if (!tells_something(measured))
    return request.output ? "No part is written, as it would have no number of its own.\n" : "";
  if (!measured.fit.misfits.empty())
    return request.page ? "" : "Next: say --page mine.html, and look at the steps that are off\n";
  if (!request.output) return "Next: write the part with -o modules/mine.toml\n";
  const fs::path folder = request.output->parent_path();
  const std::string name = shell_word(request.output->stem().string());
  const bool is_found = folder.filename() == parts_folder;
  const fs::path root = is_found ? folder.parent_path() : folder;
  const std::string shown = root.empty() ? "." : root.string();
  const std::string run =
      fmt::format("cosys-sim run {} --parts {} --set receiver.module={}",
                  shell_word(quickstart_place(request)), shell_word(shown), name);
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
  refuse_plans(request.captures);
  refuse_one_twice(request.captures);
  std::vector<LightReading> readings;
  for (std::size_t which = 0; which < request.captures.size(); ++which)
    readings.push_back(read_light(request, which, like.data));
  if (request.output) prepare_part(*request.output);
  const MeasuredModule measured = measured_module(request, like.data, std::move(readings));
  write_measured(request, measured, like);
  request.json ? print_json(measured_json(measured))
               : print(measured_text(measured) + next_line(request, measured));
  return tells_something(measured) ? ExitCode::done : ExitCode::inconclusive;
}

}  // namespace sim
