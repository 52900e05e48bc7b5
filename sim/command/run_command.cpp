#include <fmt/format.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sim/command/commands.hpp"
#include "sim/command/experiments.hpp"
#include "sim/command/run_plan.hpp"
#include "sim/engine/ordered_runs.hpp"
#include "sim/engine/process_group.hpp"
#include "sim/engine/resume.hpp"
#include "sim/failure.hpp"
#include "sim/loading/load_scenario.hpp"
#include "sim/report/experiment_run.hpp"
#include "sim/result/store.hpp"
#include "sim/scenario/experiment_kind.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/text/standard_output.hpp"
#include "sim/threads/stop_signals.hpp"
#include "sim/threads/worker_threads.hpp"

namespace sim {
namespace {

namespace fs = std::filesystem;

fs::path output_of(const RunRequest& request, const fs::path& scenario) {
  const Shard& shard = request.shard;
  fs::path name = scenario.stem();
  if (shard != Shard{}) name.concat(fmt::format("-{}of{}", shard.number, shard.count));
  name.concat(".h5");
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

/// What is to be read again has to be a file that can be.
void refuse_tables(const RunRequest& request, const fs::path& output) {
  if (request.resume) check_read_back(output, "--resume");
  if (request.shard != Shard{}) check_read_back(output, "--shard");
}

void refuse_one_file_for_several(const RunRequest& request) {
  std::error_code error;
  if (request.scenarios.size() < 2 || !request.output || !ends_as_result(*request.output) ||
      fs::is_directory(*request.output, error))
    return;
  throw bad_input(
      fmt::format("-o {} with {} scenarios", request.output->string(), request.scenarios.size()),
      "a file holds the result of one", "name a folder, such as -o results/");
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

bool is_gone_on_with(const RunRequest& request, const fs::path& output) {
  std::error_code error;
  return request.resume && fs::exists(output, error) && fs::file_size(output, error) > 0;
}

[[noreturn]] void refuse_to_time_a_job() {
  throw bad_input("--plan and --time-budget", "they time one process, not a job of several",
                  "run them without mpirun");
}

/// A scenario to be run.
struct Run {
  LoadedScenario scenario;
  fs::path output;
};

Workers workers_of(const RunRequest& request) {
  return {.threads = threads_for(request.threads),
          .interrupt = &heed_stop_signals(),
          .profiled = request.profile};
}

/// Of all scenarios what can be refused before anything is counted or written.
std::vector<Run> runs_of(const RunRequest& request) {
  refuse_one_file_for_several(request);
  refuse_same_output(request);
  std::vector<Run> runs;
  for (const fs::path& path : request.scenarios) {
    runs.push_back({load_with(request.options, path), output_of(request, path)});
    refuse_tables(request, runs.back().output);
    const LoadedScenario& scenario = runs.back().scenario;
    engine_of(scenario).check_shard(scenario, request.shard);
  }
  return runs;
}

std::unique_ptr<ReadyRun> ready_run(const RunRequest& request, Run run, ProcessGroup* processes) {
  const Workers workers = workers_of(request);
  if (request.time_budget_s > 0) run.scenario = within_budget(request, run.scenario, workers);
  const bool goes_on = is_gone_on_with(request, run.output);
  if (goes_on) check_resumable(run.output, request.program, run.scenario, request.shard);
  const ExperimentEngine& engine = engine_of(run.scenario);
  return engine.ready({.scenario = std::move(run.scenario),
                       .output = run.output,
                       .command = request.command,
                       .program = request.program,
                       .workers = workers,
                       .processes = processes,
                       .json = request.json,
                       .quiet = request.quiet,
                       .table = request.table,
                       .plot = request.plot,
                       .profile = request.profile,
                       .counted_in = goes_on ? std::vector{run.output} : std::vector<fs::path>{},
                       .shards = {request.shard}});
}

/// Whether this process prints and writes.
bool speaks(const ProcessGroup* processes) {
  return processes == nullptr || processes->rank() == 0;
}

using ReadyRuns = std::vector<std::unique_ptr<ReadyRun>>;

ReadyRuns ready_runs(const RunRequest& request, ProcessGroup* processes) {
  if (processes != nullptr && request.time_budget_s > 0) refuse_to_time_a_job();
  std::vector<Run> runs = runs_of(request);
  if (speaks(processes)) {
    make_output_folder(request);
    for (const Run& run : runs) check_writable(run.output);
  }
  ReadyRuns ready;
  for (Run& run : runs) ready.push_back(ready_run(request, std::move(run), processes));
  return ready;
}

std::string farewell(const RunRequest& request, bool kept_any) {
  const char* const interrupted = "cosys-sim: interrupted (by a signal) ";
  if (!kept_any) return std::string(interrupted) + "nothing was counted\n";
  return fmt::format(
      "{}what was counted is in the result file; the same command with {}--resume goes on\n",
      interrupted,
      request.time_budget_s > 0 ? "what was chosen in place of --time-budget, and " : "");
}

ExitCode print_plans(const RunRequest& request) {
  const Workers workers = workers_of(request);
  for (const Run& run : runs_of(request)) {
    print(engine_of(run.scenario).plan(run.scenario, request.shard, workers));
    if (workers.interrupted()) return ExitCode::interrupted;
  }
  return ExitCode::done;
}

/// Whether all members of a process group start from the same.
bool agree(const ReadyRuns& runs, ProcessGroup* processes) {
  std::string start;
  for (const auto& run : runs) start += run->start();
  return sim::agree(processes, start);
}

}  // namespace

PartRoots part_roots(const ScenarioOptions& options, const fs::path& scenario) {
  PartRoots roots = {scenario.has_parent_path() ? scenario.parent_path() : fs::path(".")};
  roots.insert(roots.end(), options.parts.begin(), options.parts.end());
  return roots;
}

LoadedScenario load_with(const ScenarioOptions& options, const fs::path& scenario) {
  LoadedScenario loaded = load_scenario(scenario, options.overrides, part_roots(options, scenario));
  check_experiment(loaded);
  return loaded;
}

void refuse_other_than_link(const LoadedScenario& scenario, const std::string& command) {
  const std::string& experiment = scenario.base.experiment;
  if (experiment != link_kind.name)
    throw bad_input(scenario.path.string(),
                    "an experiment \"" + experiment + "\" has no trials of a link",
                    command + " takes links; use run");
}

LoadedScenario load_link(const ScenarioOptions& options, const fs::path& scenario,
                         const std::string& command) {
  LoadedScenario loaded = load_with(options, scenario);
  refuse_other_than_link(loaded, command);
  return loaded;
}

ExitCode run_command(const RunRequest& request) {
  const std::unique_ptr<ProcessGroup> processes = join_process_group();
  if (request.plan && processes == nullptr) return print_plans(request);
  ReadyRuns runs;
  const bool ready = collective(processes.get(), [&] {
    if (request.plan) refuse_to_time_a_job();
    runs = ready_runs(request, processes.get());
  });
  if (!ready || !agree(runs, processes.get())) return ExitCode::done;
  const RunCounters by{workers_of(request), processes.get()};
  bool kept_any = false;
  for (std::unique_ptr<ReadyRun>& run : runs) {
    if (by.interrupted()) break;
    kept_any |= (*run)() != RunEnd::nothing;
    run.reset();
  }
  if (!by.interrupted()) return ExitCode::done;
  if (speaks(processes.get())) say(farewell(request, kept_any));
  return ExitCode::interrupted;
}

}  // namespace sim
