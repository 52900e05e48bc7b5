// `cosys-sim report`: results as pictures and tables.
#include <algorithm>
#include <deque>

#include "sim/command/commands.hpp"
#include "sim/command/experiments.hpp"
#include "sim/command/judging.hpp"
#include "sim/command/picture_files.hpp"
#include "sim/failure.hpp"
#include "sim/link_experiment/link_measurement.hpp"
#include "sim/link_experiment/range_doubt.hpp"
#include "sim/loading/point_scenario.hpp"
#include "sim/page/link_section.hpp"
#include "sim/page/page.hpp"
#include "sim/result/netcdf.hpp"
#include "sim/result/netcdf_reader.hpp"
#include "sim/result/stored_result.hpp"
#include "sim/scenario/settings.hpp"
#include "sim/text/new_file.hpp"
#include "sim/text/standard_output.hpp"
#include "sim/threads/stop_signals.hpp"
#include "sim/threads/worker_threads.hpp"

namespace sim {
namespace {

namespace fs = std::filesystem;

/// Its name without folder and ending, unless another has the same.
std::string name_of(const fs::path& path, const std::vector<fs::path>& all) {
  const auto same = [&](const fs::path& other) { return other.stem() == path.stem(); };
  return std::ranges::count_if(all, same) > 1 ? path.string() : path.stem().string();
}

/// Where the link fails, or else the first point.
std::uint64_t point_to_look_at(const LinkResult& result) {
  const LinkPoint* failing = failing_point(result);
  return static_cast<std::uint64_t>(failing == nullptr ? 0 : failing - result.points.data());
}

/// The trials of which a point's counts are, as far as their numbers are known: shards that were
/// added up may leave some out.
TrialRange counted_trials(const LinkResult& result, std::uint64_t point, const Scenario& scenario) {
  const auto most = static_cast<std::uint64_t>(scenario.stop.max_frames);
  const std::uint64_t begin = trials_of(result.shards.front(), most).first;
  return {begin, begin + result.points[point].tally.n_frames};
}

void look_closer(LinkReport& link, const StoredResult& stored, const Workers& workers) {
  const std::uint64_t point = point_to_look_at(stored.result);
  const Scenario scenario = numbered_point(stored.scenario, point);
  const TrialRange counted = counted_trials(stored.result, point, scenario);
  link.frames = look_at_frames(scenario, counted, workers);
  link.frames.are_all &= stored.result.shards.size() == 1;
  link.why_no_trial = why_no_trial(scenario);
  link.trial = trial_to_show(
      stored, point, link.frames.first_misread.value_or(static_cast<std::uint32_t>(counted.first)));
}

ReportSection link_section_of(const fs::path& path, const ReportRequest& request) {
  StoredResult stored = read_result(path);
  describe_points(stored.scenario, stored.result);
  const Workers workers{threads_for(request.threads), &heed_stop_signals()};
  LinkReport link;
  link.name = name_of(path, request.results);
  link.settings = settings_of(stored.scenario);
  link.ranking = rank(stored.result);
  add_doubts(link.ranking, stored.scenario, workers);
  if (const auto units = unit_spread(stored.result))
    link.effects = number_effects(stored.scenario, *units);
  link.ablations = ablate(stored.scenario, stored.result, workers);
  if (is_weighted(stored.result))
    link.why_no_trial =
        "No trial is shown: importance sampling does not draw them as they come by nature.\n";
  else if (!workers.interrupted())
    look_closer(link, stored, workers);
  link.result = std::move(stored.result);
  return link_section(link);
}

ReportSection section_of(const fs::path& path, const ReportRequest& request) {
  if (filetype_of(path) != experiment_result_type) return link_section_of(path, request);
  const StoredDataset stored = read_dataset(path);
  ReportSection report = report_of(name_of(path, request.results), stored);
  report.settings = settings_of(stored.scenario);
  return report;
}

/// "-" means that to other programs; a file of this name nobody wants.
void refuse_standard_output(const fs::path& output) {
  if (output == "-")
    throw bad_input("--output -", "a report goes to a file, not to stdout",
                    "name a file, such as report.html");
}

/// Its curves would hide each other.
void refuse_twice(const std::vector<fs::path>& results) {
  for (auto result = results.begin(); result != results.end(); ++result) {
    const auto is_the_same = [&](const fs::path& before) {
      std::error_code error;
      return fs::equivalent(before, *result, error);
    };
    if (std::any_of(results.begin(), result, is_the_same))
      throw bad_input(result->string(), "it is named twice", "name each result once");
  }
}

/// Its page would take the place of one of its pictures.
void refuse_same_place(const std::vector<PictureFile>& pictures, const fs::path& output) {
  const auto place_of = [](const fs::path& path) { return fs::absolute(path).lexically_normal(); };
  for (const PictureFile& picture : pictures)
    if (place_of(picture.place) == place_of(output))
      throw bad_input("--output " + output.string(), "one of the pictures is to be written there",
                      "choose another name");
}

/// All of them, or none where one cannot be written.
void write_files(const std::vector<PictureFile>& all) {
  std::deque<NewFile> files;
  for (const auto& [place, bytes] : all) {
    files.emplace_back(place).write(bytes);
    files.back().close();
  }
  for (NewFile& file : files) file.take_place();
  for (const PictureFile& file : all) print(file.place.string() + "\n");
}

}  // namespace

ExitCode report_command(const ReportRequest& request) {
  refuse_standard_output(request.output);
  refuse_twice(request.results);
  check_place(request.output, {is_page, "a report of cosys-sim"});
  require_tools(request.pictures);
  std::vector<ReportSection> reports;
  const std::atomic<bool>& stopping = heed_stop_signals();
  for (const fs::path& path : request.results) reports.push_back(section_of(path, request));
  if (stopping) return end_interrupted();
  const Page page = page_of(std::move(reports));
  auto files = picture_files(page, request.pictures);
  if (!files) return end_interrupted();
  refuse_same_place(*files, request.output);
  make_folders(request.pictures);
  files->insert(files->begin(), PictureFile{request.output, page_as_html(page)});
  write_files(*files);
  return ExitCode::done;
}

}  // namespace sim
