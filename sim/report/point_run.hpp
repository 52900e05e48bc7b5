#pragma once
// A run of an experiment from its first row to its file: points are said while they are counted,
// and kept in the file as they go.
#include <string>
#include <vector>

#include "sim/columns/columns_dataset.hpp"
#include "sim/columns/columns_table.hpp"
#include "sim/columns/point_report.hpp"
#include "sim/engine/checkpointer.hpp"
#include "sim/engine/progress_line.hpp"
#include "sim/engine/run_counting.hpp"
#include "sim/report/experiment_run.hpp"
#include "sim/report/report_table.hpp"

namespace sim {

template <class Setup, class Tally, class Point>
class PointRun {
 public:
  PointRun(const ExperimentRun& run, const Measurement<Setup, Tally, Point>& kind,
           const PointReport<Point>& report)
      : run_(run),
        report_(report),
        counting_(kind, run.scenario),
        table_(report.columns(), run.scenario, counting_.points().front()),
        rows_(run.json || !run.speaks()),
        progress_(!run.quiet && run.speaks()) {
    for (const std::string& checkpoint : run.checkpoints) counting_.add(checkpoint);
  }

  bool operator()() {
    const RunCounters by{run_.workers, run_.processes};
    counting_.describe_all(run_.workers);
    if (by.interrupted()) return leave_as_it_was();
    rows_.print(table_.head());
    for (std::size_t i = 0; i < counting_.points().size(); ++i) {
      take_point(i, by);
      if (counting_.points()[i].reached()) end_point(i);
    }
    const std::size_t all = counting_.points().size();
    const std::size_t finished = counting_.n_finished(run_.shards);
    if (run_.speaks())
      conclude(run_, rows_, dataset(), unfinished_note(all, finished, counting_.n_begun()),
               drawn_columns(report_.columns()), details());
    return finished == all;
  }

 private:
  void take_point(std::size_t i, const RunCounters& by) {
    if (run_.counts_nothing) return;
    counting_.count(i, run_.shards.front(), by, [&](std::uint32_t done, std::uint32_t all) {
      progress_.show(runs_status(i, counting_.points().size(), done, all));
      if (!run_.speaks() || !checkpointer_.is_due()) return;
      checkpointer_.keep([&] {
        counting_.bring_up_to_date();
        write();
      });
    });
    progress_.clear();
  }

  void end_point(std::size_t i) {
    if (!run_.counts_nothing && run_.speaks() && checkpointer_.is_due_at_end())
      checkpointer_.keep([&] { write(); });
    rows_.print(table_.row(counting_.points()[i]));
  }

  /// A result of no runs replaces none.
  void write() const {
    const Dataset data = dataset();
    if (data.n_runs > 0) write_dataset(run_.output, data, run_.program);
  }

  bool leave_as_it_was() const {
    if (run_.speaks()) say_left_as_it_was(run_);
    return false;
  }

  Dataset dataset() const {
    Dataset data = dataset_of(run_.scenario, run_.command, report_.columns(), counting_.points());
    data.shards = run_.shards;
    data.checkpoint = counting_.checkpoint();
    return data;
  }

  std::string details() const {
    const std::vector<Point>& points = counting_.points();
    const bool single = report_.details != nullptr && points.size() == 1 && points[0].reached();
    return single ? report_.details(run_.scenario, points[0]) : "";
  }

  const ExperimentRun& run_;
  const PointReport<Point> report_;
  RunCounting<Setup, Tally, Point> counting_;
  PointTable<Point> table_;
  Rows rows_;
  ProgressLine progress_;
  Checkpointer checkpointer_;
};

template <class Setup, class Tally, class Point>
bool run_points(const ExperimentRun& run, const Measurement<Setup, Tally, Point>& kind,
                const PointReport<Point>& report) {
  return PointRun<Setup, Tally, Point>(run, kind, report)();
}

/// An experiment for the commands, of what it tells the engine (a Measurement) and of what it says
/// of its points (a PointReport).
template <const auto& kind, const auto& report>
constexpr ExperimentEngine experiment_engine{
    .run = [](const ExperimentRun& run) { return run_points(run, kind, report); },
    .pilots = [](const LoadedScenario& scenario, const Shard& shard,
                 const Workers& workers) { return run_pilots(kind, scenario, shard, workers); },
    .columns =
        [] {
          const auto& all = report.columns().all();
          return std::vector<ColumnFacts>(all.begin(), all.end());
        }};

}  // namespace sim
