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
#include "sim/engine/checkpoint_bytes.hpp"
#include "sim/engine/measurement.hpp"
#include "sim/engine/process_group.hpp"
#include "sim/failure.hpp"
#include "sim/loading/point_scenario.hpp"
#include "sim/scenario/experiment_kind.hpp"
#include "sim/scenario/sweep.hpp"
#include "sim/threads/parallel_runs.hpp"
#include "sim/threads/stopwatch.hpp"

namespace sim {

/// Who counts runs.
struct RunCounters {
  Workers workers{};
  ProcessGroup* processes = nullptr;  // each of whose members counts the same

  /// Whether any member was told to stop.
  bool interrupted() const {
    return processes != nullptr ? processes->any(workers.interrupted()) : workers.interrupted();
  }
};

/// The first `n` runs of a shard of a point.
template <class Tally>
struct CountedRuns {
  Shard shard;
  std::uint32_t n = 0;
  Tally tally{};

  template <class Archive>
  void serialize(Archive& archive) {
    archive(shard.number, shard.count, n, tally);
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
      asked_.push_back(runs_asked_for(point));
    }
  }

  const std::vector<Point>& points() const { return points_; }

  /// How many points have any run, and all those of some shards.
  std::size_t n_begun() const {
    return static_cast<std::size_t>(
        std::ranges::count_if(counted_, [](const auto& parts) { return !parts.empty(); }));
  }
  std::size_t n_finished(const std::vector<Shard>& shards) const {
    std::size_t n = 0;
    for (std::size_t i = 0; i < counted_.size(); ++i) {
      std::uint64_t missing = 0;
      for (const Shard& shard : shards) {
        const TrialRange range = runs_of(shard, asked_[i]);
        missing += range.last - range.first;
      }
      for (const CountedRuns<Tally>& part : counted_[i]) missing -= part.n;
      n += missing == 0 ? 1 : 0;
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
    const Wanted wanted = runs_in(shard, i);
    if (has_all(i, shard, wanted) || by.interrupted()) return;
    set_up(i, by.workers);
    if (by.interrupted()) return;
    CountedRuns<Tally>& part = part_of(shard);
    if (by.processes == nullptr)
      run(part, wanted, by.workers, meanwhile);
    else
      run_collectively(part, wanted, by, meanwhile);
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

 private:
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
        const TrialRange range = runs_of(part.shard, asked_[i]);
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
    at_hand_ = i;
    setup_.reset();
    setup_.emplace(kind_.prepare(point_scenario(scenario_, point_coordinates(scenario_.sweep, i)),
                                 scenario_.places, workers));
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

  bool has_all(std::size_t i, const Shard& shard, const Wanted& wanted) const {
    return std::ranges::any_of(counted_[i], [&](const CountedRuns<Tally>& part) {
      return part.shard == shard && part.n == wanted.all;
    });
  }

  Wanted runs_in(const Shard& shard, std::size_t point) const {
    const TrialRange range = runs_of(shard, asked_[point]);
    return {static_cast<std::uint32_t>(range.first),
            static_cast<std::uint32_t>(range.last - range.first)};
  }

  void run(CountedRuns<Tally>& part, const Wanted& wanted, const Workers& workers,
           const Meanwhile& meanwhile) {
    ParallelRuns<Tally> sharing(
        {.runs = wanted.all - part.n,
         .most_at_once = kind_.most_at_once(*setup_, wanted.all, workers.threads),
         .workers = workers,
         .first = wanted.first + part.n},
        [&](std::uint32_t first, int n) {
          return kind_.run(*setup_, first, n, workers.interrupt);
        });
    const auto add = [&](Tally&& batch, std::uint32_t n) {
      part.tally += std::move(batch);
      part.n += n;
    };
    sharing.in_order(add, [&] {
      if (meanwhile) meanwhile(part.n, wanted.all);
    });
  }

  /// Each member does a share of the next runs, then all add all shares, in the order of the runs.
  void run_collectively(CountedRuns<Tally>& part, const Wanted& wanted, const RunCounters& by,
                        const Meanwhile& meanwhile) {
    const std::uint64_t least = least_share(wanted, by);
    std::uint64_t share = least;
    while (part.n < wanted.all) {
      const Stopwatch watch;
      CountedRuns<Tally> mine;
      share = std::min<std::uint64_t>(
          share, divided_up(wanted.all - part.n, static_cast<std::uint32_t>(by.processes->size())));
      run(mine, share_of_member(wanted, part.n, share, *by.processes), by.workers, {});
      const double seconds = by.processes->largest(watch.seconds());
      if (by.interrupted()) return;
      for (const std::string& bytes : by.processes->exchange(bytes_of(mine))) {
        auto theirs = from_bytes<CountedRuns<Tally>>(bytes);
        part.tally += std::move(theirs.tally);
        part.n += theirs.n;
      }
      if (meanwhile) meanwhile(part.n, wanted.all);
      share = next_share(share, seconds, least, wanted.all);
    }
  }

  /// Of a wave in which each member does a share of the runs behind the first `done`.
  static Wanted share_of_member(const Wanted& wanted, std::uint32_t done, std::uint64_t share,
                                const ProcessGroup& processes) {
    const auto at = [&](int rank) {
      const std::uint64_t behind = done + static_cast<std::uint64_t>(rank) * share;
      return static_cast<std::uint32_t>(std::min<std::uint64_t>(behind, wanted.all));
    };
    return {wanted.first + at(processes.rank()), at(processes.rank() + 1) - at(processes.rank())};
  }

  /// Runs for all threads of the member that has most. The members' processors may differ.
  std::uint64_t least_share(const Wanted& wanted, const RunCounters& by) const {
    const int threads = by.workers.threads;
    const double at_once = kind_.most_at_once(*setup_, wanted.all, threads);
    return static_cast<std::uint64_t>(by.processes->largest(at_once * threads));
  }

  const Kind& kind_;
  const LoadedScenario& scenario_;
  Counted counted_;
  std::vector<Point> points_;
  std::vector<std::uint32_t> asked_;  // runs, of each point
  std::size_t at_hand_ = 0;
  std::optional<Setup> setup_;  // of the point at hand
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
