// `cosys-sim merge`: one result of several machines' shards.
#include <fmt/format.h>

#include "sim/closing_lines.hpp"
#include "sim/commands.hpp"
#include "sim/experiment.hpp"
#include "sim/failure.hpp"
#include "sim/merge.hpp"
#include "sim/report_table.hpp"
#include "sim/standard_output.hpp"
#include "sim/store.hpp"
#include "sim/stored_result.hpp"

namespace sim {
namespace {

void refuse(const MergeRequest& request, std::size_t i, const std::string& why) {
  throw bad_input(
      fmt::format("cannot merge {} with what stands before it", request.results[i].string()), why,
      "give shards of one command, each once");
}

StoredResult merged(const MergeRequest& request) {
  StoredResult sum = read_result(request.results.front());
  for (std::size_t i = 1; i < request.results.size(); ++i) {
    const StoredResult more = read_result(request.results[i]);
    const std::string why = mismatch(sum.origin, more.origin);
    if (!why.empty()) refuse(request, i, why);
    const Shard* twice = overlapping(sum.result.shards, more.result.shards);
    if (twice != nullptr)
      refuse(request, i, "trials of its shard " + shards_text({*twice}) + " are there already");
    add(sum.result, more.result);
  }
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

}  // namespace

ExitCode merge_command(const MergeRequest& request) {
  check_writable(request.output);
  const StoredResult sum = merged(request);
  write_result(request.output, sum.result, sum.origin.program);
  print(table(sum.result, has_theory(sum.scenario)) + missing_lines(sum.result) +
        closing_lines(sum.result, request.output));
  return ExitCode::done;
}

}  // namespace sim
