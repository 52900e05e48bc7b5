#pragma once
// A run of an experiment from its first row to its file: points are said while they are counted,
// and kept in the file as they go.
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/columns/closing_lines.hpp"
#include "sim/columns/columns_dataset.hpp"
#include "sim/columns/columns_table.hpp"
#include "sim/columns/point_report.hpp"
#include "sim/columns/unit_spread_text.hpp"
#include "sim/columns/unit_values_text.hpp"
#include "sim/columns/validity_column.hpp"
#include "sim/engine/checkpointer.hpp"
#include "sim/engine/plan.hpp"
#include "sim/engine/progress_line.hpp"
#include "sim/engine/run_counting.hpp"
#include "sim/engine/shard_check.hpp"
#include "sim/report/experiment_run.hpp"
#include "sim/report/plan_report.hpp"
#include "sim/result/store.hpp"
#include "sim/result/stored_dataset.hpp"
#include "sim/result/unit_spread.hpp"
#include "sim/scenario/experiment_kind.hpp"
#include "sim/scenario/keys.hpp"
#include "sim/section/dataset_charts.hpp"
#include "sim/section/dataset_words.hpp"
#include "sim/text/digest.hpp"
#include "sim/threads/stopwatch.hpp"

namespace sim {

template <class Setup, class Tally, class Point>
class PointRun : public ReadyRun {
 public:
  PointRun(ExperimentRun run, const Measurement<Setup, Tally, Point>& kind,
           const PointReport<Point>& report)
      : run_(std::move(run)),
        report_(report),
        counting_(kind, run_.scenario, run_.shards),
        table_(report.columns(), run_.scenario, counting_.points().front(), room_of_rows(run_)),
        are_too_many_(!run_.json && are_too_many_rows(run_, counting_.points().size())),
        // a table of hundreds of units would hide what they say together
        rows_(run_.json || are_too_many_ || !run_.speaks() || has_units(run_.scenario.sweep)),
        progress_(!run_.quiet && run_.speaks()) {
    for (const std::filesystem::path& path : run_.counted_in) counting_.add(read_checkpoint(path));
  }

  std::string start() const override {
    return run_.scenario.text + digest_of(counting_.checkpoint());
  }

  RunEnd operator()() override {
    const RunCounters by{run_.workers, run_.processes};
    counting_.describe_all(run_.workers);
    if (by.interrupted()) return leave_as_it_was();
    rows_.print(table_.head());
    if (!run_.counts_nothing) rows_.check();  // the last result stays
    for (std::size_t i = 0; i < counting_.points().size(); ++i) {
      take_point(i, by);
      if (counting_.points()[i].reached() || run_.counts_nothing) end_point(i);
      show_so_far(i);
      if (by.any(rows_.have_failed())) break;  // whoever read them has seen enough
    }
    progress_.clear();
    counting_.describe_sweep();
    const std::size_t all = counting_.points().size();
    const std::size_t finished = counting_.n_finished();
    if (run_.speaks()) end(unfinished_note(all, finished, counting_.n_begun()));
    if (counting_.n_begun() == 0) return RunEnd::nothing;
    return finished == all ? RunEnd::finished : RunEnd::unfinished;
  }

 private:
  void take_point(std::size_t i, const RunCounters& by) {
    if (run_.counts_nothing) return;
    counting_.count(i, by, [&](std::uint32_t done, std::uint32_t all) {
      if (run_.speaks()) show_and_keep(i, done, all);
    });
    if (!rows_.are_silent()) progress_.clear();
  }

  /// Of many points that are counted in no time.
  void show_so_far(std::size_t i) {
    const std::size_t all = counting_.points().size();
    if (all < 2 || run_.counts_nothing || !progress_.is_due()) return;
    const std::string known =
        report_.so_far != nullptr ? report_.so_far(counting_.points(), i + 1) : "done";
    progress_.show({.point = i, .points = all, .share = 1, .counted = known});
  }

  void show_and_keep(std::size_t i, std::uint32_t done, std::uint32_t all) {
    const bool keeps = checkpointer_.is_due();
    if (keeps || report_.progress != nullptr) counting_.describe_current();
    progress_.show(runs_status({.point = i, .points = counting_.points().size()}, done, all,
                               amount_unit(run_.scenario.base), progress_text(i)));
    if (keeps) checkpointer_.keep([&] { write(); });
  }

  std::string progress_text(std::size_t i) const {
    return report_.progress != nullptr ? report_.progress(counting_.points()[i]) : "";
  }

  void end_point(std::size_t i) {
    if (!run_.counts_nothing && run_.speaks() && checkpointer_.is_due_at_end())
      checkpointer_.keep([&] { write(); });
    rows_.print(table_.row(counting_.points()[i]));
  }

  void end(const std::string& missing) {
    const Stopwatch watch;
    const Dataset data = dataset();
    conclude(
        run_, rows_, data,
        {.json =
             [&] {
               return report_.json != nullptr ? report_.json(swept(), data) : dataset_json(data);
             },
         .plots = [&] { return charts_as_text(charts(data)); },
         .missing = missing,
         .overview = are_too_many_ ? overview(data) : left_out_note(table_.left_out(), "--table"),
         .notes =
             [&] {
               return unit_spread_lines(data) + unit_value_lines(data, report_.columns().facts()) +
                      (report_.notes != nullptr ? report_.notes(swept()) : validity_notes(data));
             },
         .details = [&] { return details(); }});
    writing_s_ += watch.seconds();
    if (run_.profile) say(profile_text());
  }

  /// A result of no runs replaces none.
  void write() {
    const Stopwatch watch;
    const Dataset data = dataset();
    if (data.n_runs > 0) write_dataset(run_.output, data, run_.program);
    writing_s_ += watch.seconds();
  }

  RunEnd leave_as_it_was() const {
    if (run_.speaks()) say_left_as_it_was(run_);
    return counting_.n_begun() == 0 ? RunEnd::nothing : RunEnd::unfinished;
  }

  SweptPoints<Point> swept() const {
    return {run_.scenario, run_.command, run_.shards, counting_.points(), run_.workers};
  }

  Dataset dataset() const {
    Dataset data = dataset_of(run_.scenario, run_.command, report_.columns(), counting_.points());
    data.shards = run_.shards;
    data.checkpoint = counting_.checkpoint();
    if (report_.complete != nullptr) report_.complete(data, counting_.points());
    return data;
  }

  std::vector<Chart> charts(const Dataset& data) const {
    if (report_.charts != nullptr) return report_.charts(swept());
    std::vector<Chart> charts;
    for (const DrawnVariable& variable : drawn_columns(report_.columns()))
      if (std::optional<Chart> chart = swept_chart(data, variable); chart && !chart->curves.empty())
        charts.push_back(*std::move(chart));
    return charts;
  }

  std::string overview(const Dataset& data) const {
    return std::to_string(counting_.points().size()) + " points; --table prints a row for each\n" +
           extremes_of(data, report_.columns().facts());
  }

  std::string details() const {
    const std::vector<Point>& points = counting_.points();
    const bool single = report_.details != nullptr && points.size() == 1 && points[0].reached();
    return single ? report_.details(run_.scenario, points[0]) : "";
  }

  std::string profile_text() const {
    RunProfile profile = counting_.profile();
    profile.writing_s = writing_s_;
    const bool is_shared = run_.processes != nullptr;
    std::string text = (is_shared ? "of the first process\n" : "") + profile_lines(profile);
    if (report_.profile != nullptr)
      text += (is_shared ? "of all processes\n" : "") + report_.profile(counting_.points());
    return text;
  }

  const ExperimentRun run_;
  const PointReport<Point> report_;
  RunCounting<Setup, Tally, Point> counting_;
  PointTable<Point> table_;
  const bool are_too_many_;
  Rows rows_;
  ProgressLine progress_;
  Checkpointer checkpointer_;
  double writing_s_ = 0;
};

template <class Setup, class Tally, class Point>
std::unique_ptr<ReadyRun> ready_run(ExperimentRun run, const Measurement<Setup, Tally, Point>& kind,
                                    const PointReport<Point>& report) {
  return std::make_unique<PointRun<Setup, Tally, Point>>(std::move(run), kind, report);
}

/// An experiment for the commands, of what it tells the engine (a Measurement) and of what it says
/// of its points (a PointReport).
template <const auto& kind, const auto& report>
constexpr ExperimentEngine experiment_engine{
    .ready = [](ExperimentRun run) { return ready_run(std::move(run), kind, report); },
    .check_shard =
        [](const LoadedScenario& scenario, const Shard& shard) {
          check_shard(scenario, shard, kind.group, kind.losses != nullptr);
        },
    .plan =
        [](const LoadedScenario& scenario, const Shard& shard, const Workers& workers) {
          return plan_table(scenario, run_pilots(kind, scenario, shard, workers), workers.threads);
        },
    .amount_within =
        [](const LoadedScenario& scenario, double seconds, const Workers& workers) {
          return runs_within(run_pilots(kind, scenario, {}, workers), seconds,
                             find_key(amount_key(scenario.base))->facts.range.high);
        },
    .columns = [] { return report.columns().facts(); }};

}  // namespace sim
