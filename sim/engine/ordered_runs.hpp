#pragma once
// Does the runs of a point, by threads and by the members of a process group, and gives what they
// counted in the order of their numbers, so that the sum is the same whoever did them.
#include <algorithm>
#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "sim/engine/checkpoint_bytes.hpp"
#include "sim/engine/process_group.hpp"
#include "sim/engine/run_span.hpp"
#include "sim/threads/parallel_runs.hpp"
#include "sim/threads/stopwatch.hpp"

namespace sim {

/// Who does the runs.
struct RunCounters {
  Workers workers{};
  ProcessGroup* processes = nullptr;  // each of whose members counts the same

  /// Whether any member says so.
  bool any(bool mine) const { return processes != nullptr ? processes->any(mine) : mine; }
  /// Whether any was told to stop.
  bool interrupted() const { return any(workers.interrupted()); }
};

template <class Tally>
class OrderedRuns {
 public:
  using Spans = std::vector<RunSpan<Tally>>;
  /// Does `n` runs from `first` on. Its result is dropped once `*over` is true.
  using Work = typename ParallelRuns<Spans>::Work;
  /// Adds a span to the sum; whether more are wanted.
  using Add = std::function<bool(RunSpan<Tally>&&)>;

  OrderedRuns(const SharedRuns& shared, Work work) : shared_(shared), work_(std::move(work)) {}

  /// Until no more are wanted, all are done, or an interrupt comes. `meanwhile` is called from this
  /// thread: some ten times a second, or in a process group behind each exchange.
  void add_to(const Add& add, ProcessGroup* processes, const std::function<void()>& meanwhile) {
    if (processes == nullptr)
      add_all(shared_, add, meanwhile);
    else
      add_collectively(add, *processes, meanwhile);
  }

 private:
  void add_all(const SharedRuns& runs, const Add& add, const std::function<void()>& meanwhile) {
    ParallelRuns<Spans> parallel(runs, work_);
    parallel.in_order(
        [&](Spans&& spans, std::uint32_t) {
          return std::ranges::all_of(spans,
                                     [&](RunSpan<Tally>& span) { return add(std::move(span)); });
        },
        meanwhile);
  }

  /// Each member does a share of the next runs, then all add all shares.
  void add_collectively(const Add& add, ProcessGroup& processes,
                        const std::function<void()>& meanwhile) {
    const RunCounters by{shared_.workers, &processes};
    const std::uint32_t most = most_share(processes);
    const std::uint32_t least = std::min(least_share(processes), most);
    std::uint32_t share = least;
    for (std::uint32_t done = 0; done < shared_.runs;) {
      const Stopwatch watch;
      share = std::min(share, whole_groups(divided_up(shared_.runs - done, members(processes))));
      const SharedRuns mine = share_of_member(done, share, processes);
      Spans counted;
      add_all(
          mine, [&](RunSpan<Tally>&& span) { return counted.push_back(std::move(span)), true; },
          [] {});
      const double seconds = processes.largest(watch.seconds());
      if (by.interrupted()) return;
      if (!add_of_all(processes.exchange(bytes_of(counted)), add)) return;
      meanwhile();
      done = runs_before(done, share, processes.size());
      share = static_cast<std::uint32_t>(next_share(share, seconds, least, most));
    }
  }

  static bool add_of_all(const std::vector<std::string>& counted, const Add& add) {
    for (const std::string& bytes : counted)
      for (RunSpan<Tally>& span : from_bytes<Spans>(bytes))
        if (!add(std::move(span))) return false;
    return true;
  }

  /// Of the runs behind the first `done`.
  SharedRuns share_of_member(std::uint32_t done, std::uint32_t share,
                             const ProcessGroup& processes) const {
    const std::uint32_t begin = runs_before(done, share, processes.rank());
    SharedRuns mine = shared_;
    mine.first = shared_.first + begin;
    mine.runs = runs_before(done, share, processes.rank() + 1) - begin;
    return mine;
  }

  /// Those that are done, and the shares of so many members.
  std::uint32_t runs_before(std::uint32_t done, std::uint32_t share, int members) const {
    const std::uint64_t runs = done + static_cast<std::uint64_t>(members) * share;
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(runs, shared_.runs));
  }

  /// Runs for all threads of the member that has most. The members' processors may differ.
  std::uint32_t least_share(ProcessGroup& processes) const {
    const double at_once = shared_.least_at_once;
    return whole_groups(
        static_cast<std::uint32_t>(processes.largest(at_once * shared_.workers.threads)));
  }

  /// What all members exchange fits into memory.
  std::uint32_t most_share(const ProcessGroup& processes) const {
    constexpr std::uint32_t most = 1U << 19U, of_all = 1U << 24U;
    return whole_groups(std::min(most, of_all / members(processes)));
  }

  std::uint32_t whole_groups(std::uint32_t runs) const {
    return divided_up(runs, shared_.group) * shared_.group;
  }

  static std::uint32_t members(const ProcessGroup& processes) {
    return static_cast<std::uint32_t>(processes.size());
  }

  SharedRuns shared_;
  Work work_;
};

}  // namespace sim
