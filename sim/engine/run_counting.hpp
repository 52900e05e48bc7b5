#pragma once
// Counts the runs of all points of an experiment's sweep, in the order of their numbers, so that
// counts are the same for any number of threads, interrupts and shards.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/counting/shard.hpp"
#include "sim/counting/stop_rule.hpp"
#include "sim/engine/checkpoint_bytes.hpp"
#include "sim/engine/counted_runs.hpp"
#include "sim/engine/measurement.hpp"
#include "sim/engine/plan.hpp"
#include "sim/failure.hpp"
#include "sim/loading/point_scenario.hpp"
#include "sim/scenario/experiment_kind.hpp"
#include "sim/scenario/sweep.hpp"
#include "sim/threads/parallel_runs.hpp"
#include "sim/threads/profile.hpp"
#include "sim/threads/stopwatch.hpp"

namespace sim {

template <class Setup, class Tally, class Point>
class RunCounting {
 public:
  using Kind = Measurement<Setup, Tally, Point>;
  /// Of the runs of the point at hand in the shard: those done, and all.
  using Meanwhile = std::function<void(std::uint32_t done, std::uint32_t all)>;

  /// `shards`: of each point, whose runs are counted, or added up. Throws what `unreached` throws.
  /// The kind and the scenario must outlive this.
  RunCounting(const Kind& kind, const LoadedScenario& scenario, std::vector<Shard> shards = {{}})
      : kind_(kind),
        scenario_(scenario),
        shards_(std::move(shards)),
        counted_(count_points(scenario.sweep)) {
    for (std::size_t i = 0; i < counted_.size(); ++i) {
      const std::vector<double> coordinates = point_coordinates(scenario.sweep, i);
      const Scenario point = point_scenario(scenario, coordinates);
      points_.push_back(kind.unreached(point, scenario.places, coordinates));
      asked_.push_back({.all = runs_asked_for(point), .rule = rule_of(point.stop)});
      if (kind.losses == nullptr) asked_.back().rule.max_frame_errors = 0;
    }
  }

  const std::vector<Point>& points() const { return points_; }

  /// Where the time went, but for writing.
  RunProfile profile() const {
    return {.preparing_s = preparing_s_,
            .running_s = clock_.running_s,
            .describing_s = describing_s_,
            .n_runs = clock_.n_runs};
  }

  /// How many points have a run.
  std::size_t n_begun() const {
    return static_cast<std::size_t>(
        std::ranges::count_if(counted_, [](const auto& parts) { return !parts.empty(); }));
  }
  /// How many points have all runs of all shards, or as many as a rule wants.
  std::size_t n_finished() const {
    std::size_t n = 0;
    for (std::size_t i = 0; i < counted_.size(); ++i) n += is_finished(i) ? 1 : 0;
    return n;
  }

  /// What was counted, as bytes that add() takes.
  std::string checkpoint() const { return bytes_of(counted_); }

  /// Adds what the same program counted of the same scenario, of shards that are not here yet.
  /// Throws bad_input for bytes that are not such.
  void add(const std::string& checkpoint) {
    Counted more = counted_in(checkpoint);
    for (std::size_t i = 0; i < counted_.size(); ++i)
      for (CountedRuns<Tally>& runs : more[i]) insert(counted_[i], std::move(runs));
  }

  /// Describes all points by the runs that they have; fewer if interrupted.
  void describe_all(const Workers& workers) {
    for (std::size_t i = 0; i < counted_.size(); ++i) {
      if (counted_[i].empty()) continue;
      if (!workers.interrupted()) set_up(i, workers);
      if (workers.interrupted()) return;
      describe_current();
    }
  }

  /// Counts the runs of the first shard that a point does not have yet, and describes it. After an
  /// interrupt it has fewer, or none. `meanwhile` is called in this thread, some ten times a
  /// second; in a process group, behind each exchange.
  void count(std::size_t i, const RunCounters& by, const Meanwhile& meanwhile = {}) {
    const Shard& shard = shards_.front();
    if (is_finished(i, shard) || by.interrupted()) return;
    set_up(i, by.workers);
    if (by.interrupted()) return;
    CountedRuns<Tally>& part = part_of(shard);
    const AskedRuns asked = runs_in(shard, i);
    PointCounting<Setup, Tally, Point>(kind_, *setup_, asked, clock_).add_to(part, by, [&] {
      if (meanwhile) meanwhile(part.n, asked.all);
    });
    if (part.n == 0) counted_[i].erase(std::ranges::find(counted_[i], 0U, &CountedRuns<Tally>::n));
    describe_current();
  }

  /// Does some runs of a point, which are not counted, to see what they take and give.
  RunPilot pilot(std::size_t i, const Workers& workers) {
    Stopwatch watch;
    set_up(i, workers);
    const AskedRuns asked = runs_in(shards_.front(), i);
    RunPilot pilot{.coordinates = point_coordinates(scenario_.sweep, i),
                   .runs = asked.all,
                   .rule = asked.rule,
                   .group = kind_.group,
                   .threads = static_cast<std::uint32_t>(workers.threads),
                   .setup_s = watch.lap()};
    const auto [counted, seconds] = pilot_runs(asked, workers);
    if (counted.n == 0) return pilot;
    pilot.run_s = seconds / counted.n;
    pilot.counted = counted.n;
    pilot.ratio = kind_.ratio(*setup_, counted.tally, usual_level);
    pilot.loss = kind_.loss_of(*setup_, counted.tally, sure_level);
    if (kind_.losses != nullptr) pilot.losses = kind_.losses(counted.tally);
    return pilot;
  }

  /// What the points say of each other, behind all of them.
  void describe_sweep() {
    if (kind_.describe_sweep != nullptr) kind_.describe_sweep(scenario_, points_);
  }

  /// Describes the current point by the runs counted so far. `meanwhile` may call it.
  void describe_current() {
    const Stopwatch watch;
    describe_counted();
    describing_s_ += watch.seconds();
  }

 private:
  void describe_counted() {
    const std::vector<CountedRuns<Tally>>& parts = counted_[at_hand_];
    Point& point = points_[at_hand_];
    point.stop = stop_of(at_hand_);
    if (parts.size() == 1 && parts.front().n > 0)
      return kind_.describe(point, *setup_, parts.front().tally);
    Tally sum{};
    std::uint32_t n = 0;
    for (const CountedRuns<Tally>& part : parts) {
      sum += part.tally;
      n += part.n;
    }
    if (n > 0) kind_.describe(point, *setup_, sum);
  }

  /// Why the point has no more runs: interrupted where a shard is unfinished, else the rule that
  /// ended a shard, else max_frames.
  StopReason stop_of(std::size_t i) const {
    if (!is_finished(i)) return StopReason::interrupted;
    for (const CountedRuns<Tally>& part : counted_[i])
      if (part.stop && *part.stop != StopReason::max_frames) return *part.stop;
    return StopReason::max_frames;
  }

  using Counted = std::vector<std::vector<CountedRuns<Tally>>>;  // of each point, in their order

  Counted counted_in(const std::string& checkpoint) const {
    try {
      auto counted = from_bytes<Counted>(checkpoint);
      if (counted.size() == counted_.size() && fit(counted)) return counted;
    } catch (const std::exception&) {  // whatever cereal, or what it builds, throws
    }
    refuse_damage();
  }

  [[noreturn]] static void refuse_damage() {
    throw bad_input("the result", "the counts that it keeps cannot be read: it is damaged",
                    "choose another file");
  }

  /// Whether the shards are those of this counting, none of them twice, and each can have so many
  /// runs.
  bool fit(const Counted& counted) const {
    for (std::size_t i = 0; i < counted.size(); ++i) {
      std::vector<Shard> shards;
      for (const CountedRuns<Tally>& part : counted_[i]) shards.push_back(part.shard);
      for (const CountedRuns<Tally>& part : counted[i]) {
        const bool is_known = std::ranges::find(shards_, part.shard) != shards_.end();
        const bool is_twice = std::ranges::find(shards, part.shard) != shards.end();
        if (!is_known || is_twice || !is_possible(part, runs_in(part.shard, i).all)) return false;
        shards.push_back(part.shard);
      }
    }
    return true;
  }

  /// Whether `part` may have so many of all runs, and ended as it says.
  bool is_possible(const CountedRuns<Tally>& part, std::uint32_t all) const {
    if (part.n == all) return part.stop != StopReason::interrupted;
    const bool is_end = part.stop == StopReason::max_frames || part.stop == StopReason::interrupted;
    return part.n < all && part.n % kind_.group == 0 && !is_end && (part.n > 0 || !part.stop);
  }

  static CountedRuns<Tally>& insert(std::vector<CountedRuns<Tally>>& parts,
                                    CountedRuns<Tally> runs) {
    const auto behind = std::ranges::find_if(
        parts, [&](const auto& part) { return comes_before(runs.shard, part.shard); });
    return *parts.insert(behind, std::move(runs));
  }

  void set_up(std::size_t i, const Workers& workers) {
    const Stopwatch watch;
    at_hand_ = i;
    setup_.reset();
    setup_.emplace(kind_.prepare(point_scenario(scenario_, point_coordinates(scenario_.sweep, i)),
                                 scenario_.places, workers));
    preparing_s_ += watch.seconds();
    if (kind_.fits == nullptr || workers.interrupted()) return;
    for (const CountedRuns<Tally>& part : counted_[i])
      if (!kind_.fits(*setup_, part.tally, part.n)) refuse_damage();
  }

  CountedRuns<Tally>& part_of(const Shard& shard) {
    auto& parts = counted_[at_hand_];
    const auto found = std::ranges::find(parts, shard, &CountedRuns<Tally>::shard);
    return found != parts.end() ? *found : insert(parts, {.shard = shard});
  }

  bool is_finished(std::size_t i, const Shard& shard) const {
    return std::ranges::any_of(counted_[i], [&](const CountedRuns<Tally>& part) {
      return part.shard == shard && part.stop.has_value();
    });
  }
  bool is_finished(std::size_t i) const {
    return std::ranges::all_of(shards_, [&](const Shard& shard) {
      return runs_in(shard, i).all == 0 || is_finished(i, shard);
    });
  }

  AskedRuns runs_in(const Shard& shard, std::size_t point) const {
    const TrialRange range = runs_of(shard, asked_[point].all, kind_.group);
    return {static_cast<std::uint32_t>(range.first),
            static_cast<std::uint32_t>(range.last - range.first),
            share_of(asked_[point].rule, shard)};
  }

  struct TimedRuns {
    CountedRuns<Tally> counted{};
    double seconds = 0;
  };

  /// A batch of each thread, or more: as many as take so long that starting threads does not count,
  /// and of runs in groups four groups a thread, so that losses may be seen.
  TimedRuns pilot_runs(AskedRuns asked, const Workers& workers) {
    constexpr double long_enough_s = 0.02;
    constexpr std::uint32_t enough = 1U << 28U;
    const auto threads = static_cast<std::uint32_t>(workers.threads);
    const std::uint32_t least = kind_.group > 1 ? 4 * kind_.group : 1;
    const std::uint32_t share = divided_up(divided_up(asked.all, threads), kind_.group);
    const std::uint32_t batch =
        std::max(least, least_batch(kind_, *setup_, asked.all, workers.threads));
    asked.rule = {};
    for (asked.all = threads * std::clamp(share * kind_.group, least, batch);; asked.all *= 4) {
      const Stopwatch watch;
      TimedRuns runs;
      PointCounting<Setup, Tally, Point>(kind_, *setup_, asked, clock_)
          .add_to(runs.counted, {workers}, {});
      runs.seconds = watch.seconds();
      if (runs.seconds > long_enough_s || asked.all > enough || workers.interrupted()) return runs;
    }
  }

  const Kind& kind_;
  const LoadedScenario& scenario_;
  const std::vector<Shard> shards_;
  Counted counted_;
  std::vector<Point> points_;
  std::vector<AskedRuns> asked_;  // of each point, all shards together
  std::size_t at_hand_ = 0;
  std::optional<Setup> setup_;  // of the point at hand
  double preparing_s_ = 0, describing_s_ = 0;
  RunClock clock_{};
};

/// Of all points, for a shard; fewer if interrupted.
template <class Setup, class Tally, class Point>
std::vector<RunPilot> run_pilots(const Measurement<Setup, Tally, Point>& kind,
                                 const LoadedScenario& scenario, const Shard& shard,
                                 const Workers& workers) {
  RunCounting<Setup, Tally, Point> counting(kind, scenario, {shard});
  std::vector<RunPilot> pilots;
  for (std::size_t i = 0; i < counting.points().size(); ++i) {
    RunPilot pilot = counting.pilot(i, workers);
    if (workers.interrupted()) break;
    pilots.push_back(std::move(pilot));
  }
  return pilots;
}

}  // namespace sim
