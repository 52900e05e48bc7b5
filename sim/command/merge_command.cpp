// `cosys-sim merge`: one result of several machines' shards.
#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "sim/command/commands.hpp"
#include "sim/command/experiments.hpp"
#include "sim/engine/engine.hpp"
#include "sim/engine/experiment.hpp"
#include "sim/failure.hpp"
#include "sim/report/closing_lines.hpp"
#include "sim/report/report_table.hpp"
#include "sim/result/merge.hpp"
#include "sim/result/netcdf_reader.hpp"
#include "sim/result/store.hpp"
#include "sim/result/stored_dataset.hpp"
#include "sim/result/stored_result.hpp"
#include "sim/text/standard_output.hpp"

namespace sim {
namespace {

void refuse_merge(const MergeRequest& request, std::size_t i, const std::string& why) {
  throw bad_input(
      fmt::format("cannot merge {} with what stands before it", request.results[i].string()), why,
      "give shards of one command, each once");
}

/// A shard that was not finished can be gone on with as long as its file is there.
void refuse_to_lose_a_shard(const MergeRequest& request) {
  std::error_code error;
  for (const std::filesystem::path& result : request.results)
    if (std::filesystem::equivalent(result, request.output, error))
      throw bad_input("-o " + request.output.string(), "it is one of the results to be merged",
                      "name another file");
}

void refuse_other_program(const MergeRequest& request, const ProgramInfo& by) {
  if (by.version != request.program.version || by.commit != request.program.commit)
    throw bad_input("cannot merge " + request.results.front().string(),
                    "another version of the program counted it",
                    "use cosys-sim " + by.version + " (" + by.commit + ")");
}

const std::vector<Shard>& shards_of(const StoredResult& stored) { return stored.result.shards; }
const std::vector<Shard>& shards_of(const StoredDataset& stored) { return stored.data.shards; }

/// What is to be added up: shards of one run, none of them twice.
template <class Stored>
std::vector<Stored> read_shards(const MergeRequest& request,
                                Stored (*read)(const std::filesystem::path&)) {
  std::vector<Stored> all{read(request.results.front())};
  refuse_other_program(request, all.front().origin.program);
  for (std::size_t i = 1; i < request.results.size(); ++i) {
    Stored more = read(request.results[i]);
    const std::string why = mismatch(all.front().origin, more.origin);
    if (!why.empty()) refuse_merge(request, i, why);
    for (const Stored& before : all) {
      const Shard* twice = overlapping(shards_of(before), shards_of(more));
      if (twice != nullptr)
        refuse_merge(request, i,
                     "trials of its shard " + shards_text({*twice}) + " are there already");
    }
    all.push_back(std::move(more));
  }
  return all;
}

/// Sums of weights depend in their last digits on the order: it is that of the trials.
StoredResult merged(const MergeRequest& request) {
  std::vector<StoredResult> all = read_shards(request, read_result);
  std::ranges::sort(all, comes_before,
                    [](const StoredResult& one) { return one.result.shards.front(); });
  StoredResult sum = std::move(all.front());
  for (std::size_t i = 1; i < all.size(); ++i) add(sum.result, all[i].result);
  describe_points(sum.scenario, sum.result);
  sum.result.command = request.command;
  return sum;
}

std::string table(const ExperimentResult& result, bool theory) {
  std::string text = table_header(result.axes, theory);
  for (const PointResult& point : result.points)
    text += table_row(result.axes, point, result.ci_level, theory);
  return text;
}

/// Of experiments that are no links; whether nothing is unfinished.
bool merge_runs(const MergeRequest& request) {
  const std::vector<StoredDataset> all = read_shards(request, read_dataset);
  const LoadedScenario& scenario = all.front().scenario;
  ExperimentRun run{.scenario = scenario,
                    .output = request.output,
                    .command = request.command,
                    .program = request.program,
                    .workers = {.threads = threads_for(0)},
                    .shards = {},
                    .counts_nothing = true};
  for (const std::filesystem::path& path : request.results)
    run.checkpoints.push_back(read_checkpoint(path));
  for (const StoredDataset& stored : all)
    run.shards.insert(run.shards.end(), stored.data.shards.begin(), stored.data.shards.end());
  std::ranges::sort(run.shards, comes_before);
  return engine_of(scenario)->run(run);
}

bool merge_links(const MergeRequest& request) {
  const StoredResult sum = merged(request);
  write_result(request.output, sum.result, sum.origin.program);
  print(table(sum.result, has_theory(sum.scenario)) + missing_lines(sum.result) +
        closing_lines(sum.result, request.output));
  return unfinished_note(sum.result).empty();
}

}  // namespace

ExitCode merge_command(const MergeRequest& request) {
  refuse_to_lose_a_shard(request);
  check_writable(request.output);
  const bool links = filetype_of(request.results.front()) != experiment_result_type;
  if (!(links ? merge_links : merge_runs)(request))
    say("cosys-sim: some points are unfinished (their shards were stopped) run those shards with "
        "--resume and merge again\n");
  return ExitCode::done;
}

}  // namespace sim
