#include "sim/report/link_run.hpp"

#include <algorithm>
#include <utility>

#include "sim/engine/checkpointer.hpp"
#include "sim/engine/experiment.hpp"
#include "sim/engine/plan.hpp"
#include "sim/engine/progress_line.hpp"
#include "sim/engine/resume.hpp"
#include "sim/report/closing_lines.hpp"
#include "sim/report/finished_result.hpp"
#include "sim/report/plan_report.hpp"
#include "sim/report/report_json.hpp"
#include "sim/report/report_table.hpp"
#include "sim/report/result_charts.hpp"
#include "sim/result/merge.hpp"
#include "sim/result/store.hpp"
#include "sim/result/stored_result.hpp"
#include "sim/result/unfinished.hpp"
#include "sim/text/standard_output.hpp"

namespace sim {
namespace {

std::string profile_of(const ExperimentResult& result) {
  Profile profile;
  std::uint64_t samples = 0;
  for (const PointResult& point : result.points) {
    profile += point.profile;
    samples += point.n_samples;
  }
  return profile_lines(profile, samples);
}

/// Sums of weights depend in their last digits on the order: it is that of the trials.
ExperimentResult sum_of_files(const std::vector<std::filesystem::path>& paths) {
  std::vector<ExperimentResult> all;
  for (const std::filesystem::path& path : paths) all.push_back(read_result(path).result);
  std::ranges::sort(all, comes_before,
                    [](const ExperimentResult& one) { return one.shards.front(); });
  ExperimentResult sum = std::move(all.front());
  for (std::size_t i = 1; i < all.size(); ++i) add(sum, all[i]);
  return sum;
}

class LinkRun : public ReadyRun {
 public:
  explicit LinkRun(ExperimentRun run)
      : run_(std::move(run)),
        theory_(has_theory(run_.scenario)),
        result_(before_the_run()),
        rows_(run_.json || !run_.speaks()),
        progress_(!run_.quiet && run_.speaks()) {}

  std::string start() const override { return run_.scenario.text + result_digest(result_); }

  bool operator()() override {
    rows_.print(table_header(run_.scenario.sweep, theory_));
    if (!run_.counts_nothing) rows_.check();  // the last result stays
    if (run_.counts_nothing)
      describe_all();
    else
      result_ = run_experiment(run_.scenario, std::move(result_), options());
    if (run_.speaks()) conclude();
    return unfinished_note(result_).empty();
  }

 private:
  ExperimentResult before_the_run() const {
    ExperimentResult result = run_.counts_nothing ? sum_of_files(run_.counted_in)
                                                  : unfinished(run_.scenario, run_.command);
    result.command = run_.command;
    if (run_.counts_nothing) return result;
    result.shards = run_.shards;
    for (const std::filesystem::path& path : run_.counted_in) resume_from(path, result);
    return result;
  }

  void describe_all() {
    describe_points(run_.scenario, result_);
    for (const PointResult& point : result_.points) print_row(result_, point);
  }

  ExperimentOptions options() {
    ExperimentOptions options{.threads = run_.workers.threads,
                              .profiled = run_.profile,
                              .processes = run_.processes,
                              .interrupt = run_.workers.interrupt};
    if (!run_.speaks()) return options;
    options.on_progress = [&](const Progress& p) {
      progress_.show(status_of(p));
      if (checkpointer_.is_due()) keep(p.result);
    };
    options.on_point = [&](const ExperimentResult& result, std::size_t point) {
      progress_.clear();
      if (checkpointer_.is_due_at_end()) keep(result);
      print_row(result, result.points[point]);
      if (rows_.have_failed()) give_up(result);
    };
    return options;
  }

  void print_row(const ExperimentResult& result, const PointResult& point) {
    rows_.print(table_row(result.axes, point, result.ci_level, theory_));
  }

  /// A reader that has seen enough ends the run, but what was counted is kept.
  void give_up(const ExperimentResult& result) const {
    keep_all(result);
    rows_.check();
  }

  void keep(const ExperimentResult& result) {
    checkpointer_.keep([&] { write_result(run_.output, result, run_.program); });
  }

  void keep_all(const ExperimentResult& result) const {
    keep_finished(
        run_.output,
        [&](const std::filesystem::path& place) { write_result(place, result, run_.program); },
        [&] { return to_json(result); });
  }

  void conclude() const {
    keep_all(result_);
    rows_.check();
    if (run_.profile) say(profile_of(result_));
    if (run_.json) return print_json(to_json(result_) + "\n");
    print((run_.plot ? charts_as_text(result_charts(result_)) : "") + missing_lines(result_) +
          closing_lines(result_, run_.output));
  }

  const ExperimentRun run_;
  const bool theory_;
  ExperimentResult result_;
  Rows rows_;
  ProgressLine progress_;
  Checkpointer checkpointer_;
};

}  // namespace

constinit const ExperimentEngine link_engine{
    .ready = [](ExperimentRun run) -> std::unique_ptr<ReadyRun> {
      return std::make_unique<LinkRun>(std::move(run));
    },
    .check_shard = check_shard_of_frames,
    .plan =
        [](const LoadedScenario& scenario, const Shard& shard, const Workers& workers) {
          return plan_table(scenario.sweep, run_pilots(scenario, shard, workers), workers.threads);
        },
    .amount_within =
        [](const LoadedScenario& scenario, double seconds, const Workers& workers) {
          return frames_within(run_pilots(scenario, {}, workers), seconds);
        }};

}  // namespace sim
