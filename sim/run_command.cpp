#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>

#include "sim/commands.hpp"
#include "sim/engine.hpp"
#include "sim/experiment.hpp"
#include "sim/failure.hpp"
#include "sim/progress_line.hpp"
#include "sim/ranking.hpp"
#include "sim/report_json.hpp"
#include "sim/report_table.hpp"
#include "sim/resume.hpp"
#include "sim/scenario.hpp"
#include "sim/standard_output.hpp"
#include "sim/stop_signals.hpp"
#include "sim/store.hpp"
#include "sim/sweep.hpp"

namespace sim {
namespace {

namespace fs = std::filesystem;

fs::path output_of(const RunRequest& request, const fs::path& scenario) {
  fs::path name = scenario.stem().concat(".h5");
  if (!request.output) return name;
  std::error_code error;
  const bool folder = request.scenarios.size() > 1 || fs::is_directory(*request.output, error) ||
                      !request.output->has_filename();
  return folder ? *request.output / name : *request.output;
}

void make_output_folder(const RunRequest& request) {
  if (!request.output || (request.scenarios.size() < 2 && request.output->has_filename())) return;
  std::error_code error;
  fs::create_directories(*request.output, error);
  if (error)
    throw Failure(ExitCode::environment,
                  fmt::format("cannot create the folder {} ({}) choose another place",
                              request.output->string(), error.message()));
}

/// Two scenarios that would write one file are refused before any is run.
void refuse_same_output(const RunRequest& request) {
  for (std::size_t i = 0; i < request.scenarios.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const fs::path path = output_of(request, request.scenarios[i]);
      if (path == output_of(request, request.scenarios[j]))
        throw bad_input(
            fmt::format("{} and {} would both be written to {}", request.scenarios[j].string(),
                        request.scenarios[i].string(), path.string()),
            "they have the same name", "rename one or run them one by one");
    }
  }
}

std::string closing_lines(const ExperimentResult& result, const fs::path& output) {
  return unfinished_note(result) + validity_notes(result) + loss_reasons(result) +
         ranking_lines(result, rank(result)) +
         fmt::format("{}: digest {}\n", output.string(), result_digest(result));
}

/// Writes the file while a run goes on, points under way included: at most once a second and a
/// twentieth of the time, but every ten seconds in any case.
class Keeper {
 public:
  Keeper(fs::path output, ProgramInfo program)
      : output_(std::move(output)), program_(std::move(program)) {}

  void keep(const ExperimentResult& result, bool now) {
    if (!now && Clock::now() < next_) return;
    const auto began = Clock::now();
    write_result(output_, result, program_);
    next_ = Clock::now() + std::clamp<Clock::duration>(20 * (Clock::now() - began),
                                                       std::chrono::seconds(1),
                                                       std::chrono::seconds(10));
  }

 private:
  using Clock = std::chrono::steady_clock;

  fs::path output_;
  ProgramInfo program_;
  Clock::time_point next_ = Clock::now() + std::chrono::seconds(1);
};

/// A row may have no place to go, such as a reader that has seen enough: that ends the run, but
/// what was counted is kept.
void print_row(const ExperimentResult& result, std::size_t point, bool theory, Keeper& keeper) {
  try {
    print(table_row(result.axes, result.points[point], result.ci_level, theory));
  } catch (const Failure&) {
    keeper.keep(result, true);
    throw;
  }
}

/// Whether a receiver of the sweep is one that theory knows.
bool has_theory(const LoadedScenario& scenario) {
  bool matched = channel::is_matched(scenario.base.module);
  for (const std::vector<Scenario>& variants : scenario.variants)
    for (const Scenario& variant : variants) matched |= channel::is_matched(variant.module);
  return matched;
}

/// Nothing counted yet; or what the result file has, where there is one to go on with.
ExperimentResult so_far(const RunRequest& request, const LoadedScenario& scenario,
                        const fs::path& output) {
  ExperimentResult result = unfinished(scenario, request.command);
  std::error_code error;
  if (request.resume && fs::exists(output, error) && fs::file_size(output, error) > 0)
    resume_from(output, request.program, result);
  return result;
}

void run_scenario(const RunRequest& request, const LoadedScenario& scenario, const fs::path& output,
                  const std::atomic<bool>& interrupt) {
  Keeper keeper(output, request.program);
  ProgressLine progress(!request.quiet);
  const bool theory = has_theory(scenario);
  if (!request.json) print(table_header(scenario.sweep, theory));
  ExperimentOptions options{.threads = request.threads > 0 ? request.threads : default_threads(),
                            .interrupt = &interrupt};
  options.on_progress = [&](const Progress& p) {
    progress.show(p);
    keeper.keep(p.result, false);
  };
  options.on_point = [&](const ExperimentResult& result, std::size_t point) {
    progress.clear();
    keeper.keep(result, false);
    if (!request.json) print_row(result, point, theory, keeper);
  };
  const ExperimentResult result =
      run_experiment(scenario, so_far(request, scenario, output), options);
  keeper.keep(result, true);
  print(request.json ? to_json(result) + "\n" : closing_lines(result, output));
}

}  // namespace

LoadedScenario load_with(const ScenarioOptions& options, const fs::path& scenario) {
  PartRoots roots = {scenario.has_parent_path() ? scenario.parent_path() : fs::path(".")};
  roots.insert(roots.end(), options.parts.begin(), options.parts.end());
  return load_scenario(scenario, options.overrides, roots);
}

ExitCode run_command(const RunRequest& request) {
  refuse_same_output(request);
  std::vector<LoadedScenario> scenarios;
  for (const fs::path& path : request.scenarios)
    scenarios.push_back(load_with(request.options, path));
  make_output_folder(request);
  for (const fs::path& path : request.scenarios) check_writable(output_of(request, path));
  const std::atomic<bool>& interrupt = heed_stop_signals();
  for (std::size_t i = 0; i < scenarios.size() && !interrupt; ++i)
    run_scenario(request, scenarios[i], output_of(request, request.scenarios[i]), interrupt);
  if (!interrupt) return ExitCode::done;
  say("cosys-sim: interrupted (by a signal) what was counted is in the result file; the same "
      "command with --resume goes on\n");
  return ExitCode::interrupted;
}

}  // namespace sim
