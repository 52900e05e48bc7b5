#pragma once
// Counts the runs of all points of an experiment's sweep, in the order of their numbers, so that
// counts are the same for any number of threads, interrupts and shards.
#include <algorithm>
#include <cereal/archives/portable_binary.hpp>
#include <cereal/types/array.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/vector.hpp>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "sim/counting/shard.hpp"
#include "sim/engine/measurement.hpp"
#include "sim/engine/team.hpp"
#include "sim/loading/point_scenario.hpp"
#include "sim/scenario/experiment_kind.hpp"
#include "sim/scenario/sweep.hpp"
#include "sim/threads/run_sharing.hpp"
#include "sim/threads/stopwatch.hpp"

namespace sim {

/// What cereal makes of a value, and back.
template <class T>
std::string bytes_of(const T& value) {
  std::ostringstream bytes;
  cereal::PortableBinaryOutputArchive archive(bytes);
  archive(value);
  return bytes.str();
}

template <class T>
T from_bytes(const std::string& text) {
  std::istringstream bytes(text);
  cereal::PortableBinaryInputArchive archive(bytes);
  T value;
  archive(value);
  return value;
}

/// Who counts runs.
struct RunCounters {
  Workers workers{};
  Team* team = nullptr;  // each of whose members counts the same

  /// Whether any member was told to stop.
  bool interrupted() const {
    return team != nullptr ? team->any(workers.interrupted()) : workers.interrupted();
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
      points_.push_back(
          kind.unreached(point_scenario(scenario, coordinates), scenario.places, coordinates));
    }
  }

  const std::vector<Point>& points() const { return points_; }

  /// What was counted, as bytes that add() takes.
  std::string checkpoint() const { return bytes_of(counted_); }

  /// Adds what the same program counted of the same scenario, of shards that are not here yet.
  void add(const std::string& checkpoint) {
    auto more = from_bytes<Counted>(checkpoint);
    for (std::size_t i = 0; i < counted_.size(); ++i)
      for (CountedRuns<Tally>& runs : more.at(i)) insert(counted_[i], std::move(runs));
  }

  /// Describes a point by the runs that it has; leaves one without runs as it is.
  void describe(std::size_t i, int threads) {
    if (counted_[i].empty()) return;
    set_up(i, {.threads = threads});
    bring_up_to_date();
  }

  /// Counts the runs of a shard that a point does not have yet, and describes it. After an
  /// interrupt it has fewer, or none. `meanwhile` is called in this thread, ten times a second at
  /// least.
  void count(std::size_t i, const Shard& shard, const RunCounters& by,
             const Meanwhile& meanwhile = {}) {
    if (!by.interrupted()) set_up(i, by.workers);
    if (by.interrupted()) return describe(i, by.workers.threads);
    CountedRuns<Tally>& part = part_of(shard);
    const Wanted wanted = runs_in(shard);
    if (by.team == nullptr)
      run(part, wanted, by.workers, meanwhile);
    else
      run_in_team(part, wanted, by, meanwhile);
    if (part.n == 0) counted_[i].erase(std::ranges::find(counted_[i], 0U, &CountedRuns<Tally>::n));
    bring_up_to_date();
  }

  /// Times a lot of runs for each thread; they are not counted.
  RunPilot pilot(std::size_t i, const Shard& shard, const Workers& workers) {
    Stopwatch watch;
    set_up(i, workers);
    RunPilot pilot{.coordinates = point_coordinates(scenario_.sweep, i), .setup_s = watch.lap()};
    const Wanted wanted = runs_in(shard);
    pilot.runs = wanted.all;
    const std::uint32_t at_once = kind_.most_at_once(*setup_, wanted.all, workers.threads);
    const std::uint64_t lots = std::uint64_t{at_once} * static_cast<std::uint64_t>(workers.threads);
    CountedRuns<Tally> few;
    run(few, {wanted.first, static_cast<std::uint32_t>(std::min<std::uint64_t>(lots, wanted.all))},
        workers, {});
    pilot.run_s = watch.lap() / std::max(few.n, 1U);
    return pilot;
  }

  /// Describes the point at hand by the runs that it has at the moment.
  void bring_up_to_date() {
    const std::vector<CountedRuns<Tally>>& parts = counted_[at_hand_];
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

  static CountedRuns<Tally>& insert(std::vector<CountedRuns<Tally>>& parts,
                                    CountedRuns<Tally> runs) {
    const auto behind = std::ranges::find_if(
        parts, [&](const auto& part) { return comes_before(runs.shard, part.shard); });
    return *parts.insert(behind, std::move(runs));
  }

  void set_up(std::size_t i, const Workers& workers) {
    at_hand_ = i;
    setup_.reset();
    at_hand_scenario_ = point_scenario(scenario_, point_coordinates(scenario_.sweep, i));
    setup_.emplace(kind_.prepare(at_hand_scenario_, scenario_.places, workers));
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

  /// Of the point at hand.
  Wanted runs_in(const Shard& shard) const {
    const TrialRange range = runs_of(shard, runs_asked_for(at_hand_scenario_));
    return {static_cast<std::uint32_t>(range.first),
            static_cast<std::uint32_t>(range.last - range.first)};
  }

  void run(CountedRuns<Tally>& part, const Wanted& wanted, const Workers& workers,
           const Meanwhile& meanwhile) {
    RunSharing<Tally> sharing(
        {.runs = wanted.all - part.n,
         .most_at_once = kind_.most_at_once(*setup_, wanted.all, workers.threads),
         .workers = workers,
         .first = wanted.first + part.n},
        [&](std::uint32_t first, int n) {
          return kind_.run(*setup_, first, n, workers.interrupt);
        });
    const auto add = [&](Tally&& lot, std::uint32_t n) {
      part.tally += std::move(lot);
      part.n += n;
    };
    sharing.in_order(add, [&] {
      if (meanwhile) meanwhile(part.n, wanted.all);
    });
  }

  /// Each member does a share of the next runs, then all add all shares, in the order of the runs.
  void run_in_team(CountedRuns<Tally>& part, const Wanted& wanted, const RunCounters& by,
                   const Meanwhile& meanwhile) {
    const std::uint64_t least = least_share(wanted, by);
    std::uint64_t share = least;
    while (part.n < wanted.all) {
      const Stopwatch watch;
      CountedRuns<Tally> mine;
      run(mine, share_of_member(wanted, part.n, share, *by.team), by.workers, {});
      const double seconds = by.team->largest(watch.seconds());
      if (by.interrupted()) return;
      for (const std::string& bytes : by.team->exchange(bytes_of(mine))) {
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
                                const Team& team) {
    const auto at = [&](int rank) {
      const std::uint64_t behind = done + static_cast<std::uint64_t>(rank) * share;
      return static_cast<std::uint32_t>(std::min<std::uint64_t>(behind, wanted.all));
    };
    return {wanted.first + at(team.rank()), at(team.rank() + 1) - at(team.rank())};
  }

  /// Runs for all threads of the member that has most. The members' processors may differ.
  std::uint64_t least_share(const Wanted& wanted, const RunCounters& by) const {
    const int threads = by.workers.threads;
    const double at_once = kind_.most_at_once(*setup_, wanted.all, threads);
    return static_cast<std::uint64_t>(by.team->largest(at_once * threads));
  }

  const Kind& kind_;
  const LoadedScenario& scenario_;
  Counted counted_;
  std::vector<Point> points_;
  std::size_t at_hand_ = 0;
  Scenario at_hand_scenario_;
  std::optional<Setup> setup_;  // of the point at hand
};

/// All points of a scenario. After an interrupt the one at hand has the runs that were finished,
/// those behind it none. `on_point`: called after each point that was reached.
template <class Setup, class Tally, class Point>
std::vector<Point> counted_points(
    const Measurement<Setup, Tally, Point>& kind, const LoadedScenario& scenario,
    const Workers& workers = {},
    const std::type_identity_t<std::function<void(const Point&)>>& on_point = {}) {
  RunCounting<Setup, Tally, Point> counting(kind, scenario);
  for (std::size_t i = 0; i < counting.points().size(); ++i) {
    counting.count(i, {}, {workers});
    if (on_point && counting.points()[i].reached()) on_point(counting.points()[i]);
  }
  return counting.points();
}

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
