// `cosys-sim report`: results as pictures and tables.
#include <fmt/format.h>

#include <map>

#include "sim/command/commands.hpp"
#include "sim/command/judging.hpp"
#include "sim/engine/engine.hpp"
#include "sim/engine/experiment.hpp"
#include "sim/failure.hpp"
#include "sim/loading/point_scenario.hpp"
#include "sim/page/page.hpp"
#include "sim/page/report_contents.hpp"
#include "sim/picture/svg.hpp"
#include "sim/result/stored_result.hpp"
#include "sim/text/existing_file.hpp"
#include "sim/text/new_file.hpp"
#include "sim/text/standard_output.hpp"
#include "sim/threads/stop_signals.hpp"
#include "sim/trace/traced_message.hpp"

namespace sim {
namespace {

namespace fs = std::filesystem;

/// The first that is misread where the link fails, or else the first of all: with taps, if any.
std::optional<TracedTrial> trial_to_show(const StoredResult& stored) {
  constexpr std::uint32_t enough = 20;
  const std::vector<PointResult>& points = stored.result.points;
  const PointResult* failing = failing_point(stored.result);
  const auto number = static_cast<std::uint64_t>(failing == nullptr ? 0 : failing - points.data());
  const Scenario point = numbered_point(stored.scenario, number);
  if (point.simulation.fidelity != "waveform" || is_weighted(stored.result)) return std::nullopt;
  std::optional<TracedTrial> first;
  for (std::uint32_t i = 0; i < (failing == nullptr ? 1 : enough); ++i) {
    TracedTrial trial = trace_trial(point, i);
    trial.origin = {.program = stored.origin.program,
                    .scenario_toml = stored.origin.scenario_toml,
                    .seed = stored.origin.seed,
                    .point = number,
                    .trial = i};
    if (message_of(trial).sent.empty()) return std::nullopt;
    if (message_of(trial).first_wrong()) return trial;
    if (!first) first = std::move(trial);
  }
  return first;
}

ReportedResult read(const fs::path& path, int threads) {
  StoredResult stored = read_result(path);
  describe_points(stored.scenario, stored.result);
  Omissions omissions = leave_out(stored.scenario, stored.result, threads, heed_stop_signals());
  std::optional<TracedTrial> trial = trial_to_show(stored);
  return {path.stem().string(), std::move(stored.result), std::move(omissions), std::move(trial)};
}

void write_file(const fs::path& path, const std::string& text) {
  NewFile file(path);
  file.write(text);
  file.take_place();
}

using PlacedPictures = std::map<fs::path, const PagePicture*>;

/// The files that pictures become: bit-errors.svg, bit-errors-2.svg...
PlacedPictures places_of(const Page& page, const fs::path& folder) {
  PlacedPictures places;
  for (const PageSection& section : page.sections) {
    if (!section.picture) continue;
    const std::string& name = section.picture->name;
    fs::path place = folder / (name + ".svg");
    for (int i = 2; places.contains(place); ++i) place = folder / fmt::format("{}-{}.svg", name, i);
    places[place] = &*section.picture;
  }
  return places;
}

fs::path made_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw Failure(ExitCode::environment,
                  fmt::format("cannot create the folder {} ({}) choose another place",
                              folder.string(), error.message()));
  return folder;
}

void write_pictures(const PlacedPictures& places) {
  for (const auto& [path, picture] : places) {
    write_file(path, picture->svg);
    print(path.string() + "\n");
  }
}

}  // namespace

ExitCode report_command(const ReportRequest& request) {
  refuse_to_lose(request.output, is_page, "a report of cosys-sim");
  std::vector<ReportedResult> results;
  const std::atomic<bool>& stopping = heed_stop_signals();
  for (const fs::path& path : request.results)
    results.push_back(read(path, threads_for(request.threads)));
  if (stopping) return end_interrupted();
  const Page page = report_of(results);
  PlacedPictures pictures;
  if (request.pictures) pictures = places_of(page, made_folder(*request.pictures));
  for (const auto& [path, picture] : pictures)
    refuse_to_lose(path, is_drawing, "a picture of cosys-sim");
  write_file(request.output, page_as_html(page));
  print(request.output.string() + "\n");
  write_pictures(pictures);
  return ExitCode::done;
}

}  // namespace sim
