// `cosys-sim merge`: one result of several machines' shards.
#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "sim/command/commands.hpp"
#include "sim/command/experiments.hpp"
#include "sim/counting/shard.hpp"
#include "sim/failure.hpp"
#include "sim/result/netcdf_reader.hpp"
#include "sim/result/store.hpp"
#include "sim/result/stored_result.hpp"
#include "sim/text/input_file.hpp"
#include "sim/text/standard_output.hpp"
#include "sim/threads/worker_threads.hpp"

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

/// What is to be added up, and of which trials or runs it is.
struct ShardFile {
  Origin origin;
  std::vector<Shard> shards;
};

ShardFile shard_file(const std::filesystem::path& path) {
  refuse_no_file(path, "result");
  const std::string type = filetype_of(path);
  const bool is_result = type == link_result_type || type == experiment_result_type;
  if (is_result) {
    const NetcdfReader file(path);
    if (auto shards = shards_of(file); shards && !shards->empty())
      return {origin_of(file), std::move(*shards)};
  }
  throw bad_input(path.string(), "not a result of cosys-sim, or damaged",
                  "give a file that run wrote");
}

/// Shards of one run, none of them twice.
std::vector<ShardFile> shard_files(const MergeRequest& request) {
  std::vector<ShardFile> all{shard_file(request.results.front())};
  refuse_other_program(request, all.front().origin.program);
  for (std::size_t i = 1; i < request.results.size(); ++i) {
    ShardFile more = shard_file(request.results[i]);
    const std::string why = mismatch(all.front().origin, more.origin);
    if (!why.empty()) refuse_merge(request, i, why);
    for (const ShardFile& before : all) {
      const Shard* twice = overlapping(before.shards, more.shards);
      if (twice != nullptr)
        refuse_merge(request, i,
                     "trials of its shard " + shards_text({*twice}) + " are there already");
    }
    all.push_back(std::move(more));
  }
  return all;
}

}  // namespace

ExitCode merge_command(const MergeRequest& request) {
  refuse_to_lose_a_shard(request);
  check_writable(request.output);
  const std::vector<ShardFile> all = shard_files(request);
  ExperimentRun run{.scenario = readable_scenario(all.front().origin, request.results.front()),
                    .output = request.output,
                    .command = request.command,
                    .program = request.program,
                    .workers = {.threads = threads_for(0)},
                    .counted_in = request.results,
                    .shards = {},
                    .counts_nothing = true};
  for (const ShardFile& file : all)
    run.shards.insert(run.shards.end(), file.shards.begin(), file.shards.end());
  std::ranges::sort(run.shards, comes_before);
  const ExperimentEngine& engine = engine_of(run.scenario);
  if ((*engine.ready(std::move(run)))() != RunEnd::finished)
    say("cosys-sim: some points are unfinished (their shards were stopped) run those shards with "
        "--resume and merge again\n");
  return ExitCode::done;
}

}  // namespace sim
