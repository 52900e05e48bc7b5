#pragma once
// Counts the runs of all points of an experiment's sweep, in the order of their numbers, so that
// counts are the same for any number of threads, interrupts and shards.
#include <algorithm>
#include <atomic>
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
#include "sim/engine/measurement.hpp"
#include "sim/engine/ordered_runs.hpp"
#include "sim/failure.hpp"
#include "sim/loading/point_scenario.hpp"
#include "sim/scenario/experiment_kind.hpp"
#include "sim/scenario/sweep.hpp"
#include "sim/threads/parallel_runs.hpp"
#include "sim/threads/profile.hpp"
#include "sim/threads/stopwatch.hpp"

namespace sim {

/// The first `n` runs of a shard of a point.
template <class Tally>
struct CountedRuns {
  Shard shard;
  std::uint32_t n = 0;
  bool is_enough = false;  // its stop rule wants no more
  Tally tally{};

  template <class Archive>
  void serialize(Archive& archive) {
    archive(shard.number, shard.count, n, is_enough, tally);
  }
};

template <class Setup, class Tally, class Point>
class RunCounting {
 public:
  using Kind = Measurement<Setup, Tally, Point>;
  /// Of the runs of the point at hand in the shard: those done, and all.
  using Meanwhile = std::function<void(std::uint32_t done, std::uint32_t all)>;

  /// Throws what `unreached` throws. Both must outlive this.
  RunCounting(const Kind& kind, const LoadedScenario& scenario)
      : kind_(kind), scenario_(scenario), counted_(count_points(scenario.sweep)) {
    for (std::size_t i = 0; i < counted_.size(); ++i) {
      const std::vector<double> coordinates = point_coordinates(scenario.sweep, i);
      const Scenario point = point_scenario(scenario, coordinates);
      points_.push_back(kind.unreached(point, scenario.places, coordinates));
      asked_.push_back({runs_asked_for(point), rule_of(point.stop)});
    }
  }

  const std::vector<Point>& points() const { return points_; }

  /// Where the time went, but for writing.
  RunProfile profile() const {
    return {.preparing_s = preparing_s_,
            .running_s = running_s_,
            .describing_s = describing_s_,
            .n_runs = n_run_};
  }

  /// How many points have any run, and all those of some shards.
  std::size_t n_begun() const {
    return static_cast<std::size_t>(
        std::ranges::count_if(counted_, [](const auto& parts) { return !parts.empty(); }));
  }
  std::size_t n_finished(const std::vector<Shard>& shards) const {
    std::size_t n = 0;
    for (std::size_t i = 0; i < counted_.size(); ++i) {
      const auto is_whole = [&](const Shard& shard) {
        return runs_in(shard, i).all == 0 || is_finished(i, shard);
      };
      n += std::ranges::all_of(shards, is_whole) ? 1 : 0;
    }
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
      bring_up_to_date();
    }
  }

  /// Counts the runs of a shard that a point does not have yet, and describes it. After an
  /// interrupt it has fewer, or none. `meanwhile` is called in this thread, some ten times a
  /// second; in a process group, behind each exchange.
  void count(std::size_t i, const Shard& shard, const RunCounters& by,
             const Meanwhile& meanwhile = {}) {
    if (is_finished(i, shard) || by.interrupted()) return;
    set_up(i, by.workers);
    if (by.interrupted()) return;
    CountedRuns<Tally>& part = part_of(shard);
    run(part, runs_in(shard, i), by, meanwhile);
    if (part.n == 0) counted_[i].erase(std::ranges::find(counted_[i], 0U, &CountedRuns<Tally>::n));
    bring_up_to_date();
  }

  /// Times a batch of runs of one thread; they are not counted.
  RunPilot pilot(std::size_t i, const Shard& shard, const Workers& workers) {
    Stopwatch watch;
    set_up(i, workers);
    RunPilot pilot{.coordinates = point_coordinates(scenario_.sweep, i), .setup_s = watch.lap()};
    const Wanted wanted = runs_in(shard, i);
    pilot.runs = wanted.all;
    pilot.is_at_most = looks_at_ratio(asked_[i].rule);
    const auto threads = static_cast<std::uint32_t>(workers.threads);
    const std::uint32_t batch =
        std::clamp(divided_up(wanted.all, threads), 1U,
                   kind_.most_at_once(*setup_, wanted.all, workers.threads));
    kind_.run(*setup_, wanted.first, static_cast<int>(batch), workers.interrupt);
    const std::uint32_t rounds = divided_up(divided_up(wanted.all, batch), threads);
    pilot.run_s = watch.lap() * rounds / std::max(wanted.all, 1U);
    return pilot;
  }

  /// Describes the point at hand, to be called by `meanwhile`, by the runs that it has.
  void bring_up_to_date() {
    const Stopwatch watch;
    describe_at_hand();
    describing_s_ += watch.seconds();
  }

 private:
  void describe_at_hand() {
    const std::vector<CountedRuns<Tally>>& parts = counted_[at_hand_];
    if (parts.size() == 1 && parts.front().n > 0)
      return kind_.describe(points_[at_hand_], *setup_, parts.front().tally);
    Tally sum{};
    std::uint32_t n = 0;
    for (const CountedRuns<Tally>& part : parts) {
      sum += part.tally;
      n += part.n;
    }
    if (n > 0) kind_.describe(points_[at_hand_], *setup_, sum);
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

  /// Whether the shards are apart, and none has more runs than are its.
  bool fit(const Counted& counted) const {
    for (std::size_t i = 0; i < counted.size(); ++i) {
      std::vector<Shard> shards;
      for (const CountedRuns<Tally>& part : counted_[i]) shards.push_back(part.shard);
      for (const CountedRuns<Tally>& part : counted[i]) {
        if (!is_shard(part.shard)) return false;
        const TrialRange range = runs_of(part.shard, asked_[i].runs);
        if (part.n > range.last - range.first) return false;
        const auto overlaps = [&](const Shard& other) { return overlap(part.shard, other); };
        if (std::ranges::any_of(shards, overlaps)) return false;
        shards.push_back(part.shard);
      }
    }
    return true;
  }

  static bool is_shard(const Shard& shard) {
    return shard.number >= 1 && shard.number <= shard.count && shard.count <= most_shards;
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
      if (!kind_.fits(*setup_, part.tally)) refuse_damage();
  }

  CountedRuns<Tally>& part_of(const Shard& shard) {
    auto& parts = counted_[at_hand_];
    const auto found = std::ranges::find(parts, shard, &CountedRuns<Tally>::shard);
    return found != parts.end() ? *found : insert(parts, {.shard = shard});
  }

  /// Runs of a shard.
  struct Wanted {
    std::uint32_t first, all;
  };

  bool is_finished(std::size_t i, const Shard& shard) const {
    return std::ranges::any_of(counted_[i], [&](const CountedRuns<Tally>& part) {
      return part.shard == shard && (part.is_enough || part.n == runs_in(shard, i).all);
    });
  }

  Wanted runs_in(const Shard& shard, std::size_t point) const {
    const TrialRange range = runs_of(shard, asked_[point].runs);
    return {static_cast<std::uint32_t>(range.first),
            static_cast<std::uint32_t>(range.last - range.first)};
  }

  void run(CountedRuns<Tally>& part, const Wanted& wanted, const RunCounters& by,
           const Meanwhile& meanwhile) {
    const StopRule& rule = asked_[at_hand_].rule;
    OrderedRuns<Tally> runs(
        {.runs = wanted.all - part.n,
         .most_at_once = kind_.most_at_once(*setup_, wanted.all, by.workers.threads),
         .workers = by.workers,
         .first = wanted.first + part.n},
        [&](std::uint32_t first, int n, const std::atomic<bool>* over) {
          return spans(wanted.first, first - wanted.first, static_cast<std::uint32_t>(n), over);
        });
    const auto add = [&](RunSpan<Tally>&& span) {
      part.tally += std::move(span.tally);
      part.n += span.n;
      part.is_enough = looks_at_ratio(rule) && is_look(part.n) && is_enough(rule, part.tally);
      return !part.is_enough;
    };
    runs.add_to(add, by.processes, [&] {
      if (meanwhile) meanwhile(part.n, wanted.all);
    });
  }

  /// Some of a shard's runs, behind its first `done`; a span for each look of the rule.
  typename OrderedRuns<Tally>::Spans spans(std::uint32_t first_of_shard, std::uint32_t done,
                                           std::uint32_t n, const std::atomic<bool>* over) {
    const Stopwatch watch;
    const bool looks = looks_at_ratio(asked_[at_hand_].rule);
    typename OrderedRuns<Tally>::Spans spans;
    for (const std::uint32_t end = done + n; done < end && !is_stopped(over);) {
      const std::uint32_t next = looks ? std::min(end, next_look(done)) : end;
      spans.push_back({next - done, kind_.run(*setup_, first_of_shard + done,
                                              static_cast<int>(next - done), over)});
      done = next;
    }
    running_s_ += watch.seconds();
    n_run_ += n;
    return spans;
  }

  bool is_enough(const StopRule& rule, const Tally& tally) const {
    return stop_reason(rule, [&](double level) { return kind_.ratio(*setup_, tally, level); })
        .has_value();
  }

  const Kind& kind_;
  const LoadedScenario& scenario_;
  Counted counted_;
  std::vector<Point> points_;
  /// Of a point: how many runs, unless its rule needs fewer.
  struct Asked {
    std::uint32_t runs;
    StopRule rule;
  };
  std::vector<Asked> asked_;  // of each point
  std::size_t at_hand_ = 0;
  std::optional<Setup> setup_;  // of the point at hand
  double preparing_s_ = 0, describing_s_ = 0;
  std::atomic<double> running_s_ = 0;
  std::atomic<std::uint64_t> n_run_ = 0;  // by this process, in vain too
};

/// Of all points, for a shard; fewer if interrupted.
template <class Setup, class Tally, class Point>
std::vector<RunPilot> run_pilots(const Measurement<Setup, Tally, Point>& kind,
                                 const LoadedScenario& scenario, const Shard& shard,
                                 const Workers& workers) {
  RunCounting<Setup, Tally, Point> counting(kind, scenario);
  std::vector<RunPilot> pilots;
  for (std::size_t i = 0; i < counting.points().size(); ++i) {
    RunPilot pilot = counting.pilot(i, shard, workers);
    if (workers.interrupted()) break;
    pilots.push_back(std::move(pilot));
  }
  return pilots;
}

}  // namespace sim
