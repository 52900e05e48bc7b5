#include "sim/report/experiment_run.hpp"

#include <fmt/format.h>

#include "sim/columns/validity_column.hpp"
#include "sim/report/closing_lines.hpp"
#include "sim/report/finished_result.hpp"
#include "sim/text/standard_output.hpp"

namespace sim {
namespace {

std::string plots(const Dataset& data, const std::vector<DrawnVariable>& drawn) {
  std::vector<Chart> charts;
  for (const DrawnVariable& variable : drawn)
    if (const std::optional<Chart> chart = swept_chart(data, variable);
        chart && !chart->curves.empty())
      charts.push_back(*chart);
  return charts_as_text(charts);
}

}  // namespace

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

void say_left_as_it_was(const ExperimentRun& run) {
  say(fmt::format("{}: nothing was finished, the file is left as it was\n", run.output.string()));
}

void conclude(const ExperimentRun& run, const Rows& rows, const Dataset& data,
              const std::string& missing, const std::vector<DrawnVariable>& drawn,
              const std::string& details) {
  if (data.n_runs == 0 && run.workers.interrupted()) return say_left_as_it_was(run);
  keep_finished(
      run.output,
      [&](const std::filesystem::path& place) { write_dataset(place, data, run.program); },
      [&] { return dataset_json(data); });
  rows.check();
  if (run.json) return print_json(dataset_json(data) + "\n");
  if (run.plot) print(plots(data, drawn));
  print(missing + validity_notes(data));
  if (!details.empty()) print("\n" + details);
  print(shards_note(data.shards));
  print(fmt::format("{}: digest {}\n", run.output.string(), dataset_digest(data)));
}

}  // namespace sim
