#include "sim/report/experiment_run.hpp"

#include <fmt/format.h>

#include "sim/columns/closing_lines.hpp"
#include "sim/report/finished_result.hpp"
#include "sim/result/store.hpp"
#include "sim/text/standard_output.hpp"

namespace sim {

void Rows::print(const std::string& text) {
  if (silent_ || failure_) return;
  try {
    sim::print(text);
  } catch (const Failure&) {
    failure_ = std::current_exception();
  }
}

void Rows::check() const {
  if (failure_) std::rethrow_exception(failure_);
}

int room_of_rows(const ExperimentRun& run) {
  return run.table || run.json ? 0 : terminal_columns();
}

bool are_too_many_rows(const ExperimentRun& run, std::size_t points) {
  constexpr std::size_t most = 40;
  return !run.table && points > most && is_terminal();
}

void say_left_as_it_was(const ExperimentRun& run) {
  say(fmt::format("{}: nothing was finished, the file is left as it was\n", run.output.string()));
}

void conclude(const ExperimentRun& run, const Rows& rows, const Dataset& data,
              const ResultTexts& texts) {
  if (data.n_runs == 0 && !run.counts_nothing) return say_left_as_it_was(run);
  keep_finished(
      run.output,
      [&](const std::filesystem::path& place) { write_dataset(place, data, run.program); },
      texts.json);
  rows.check();
  if (run.json) return print_json(texts.json() + "\n");
  if (run.plot) print(texts.plots());
  print(texts.overview + texts.missing + shards_note(data.shards) + texts.notes());
  if (const std::string details = texts.details(); !details.empty()) print("\n" + details);
  print(kept_line(run.output, dataset_digest(data)));
}

}  // namespace sim
