#pragma once
// Counts the runs of one shard of a point, in the order of their numbers, until they are done or a
// stop rule has enough of them. The rule looks at what the first runs counted, never at a clock, so
// it ends at the same run for any number of threads, processes and interrupts; what was run beyond
// it is thrown away.
#include <algorithm>
#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>

#include "sim/counting/shard.hpp"
#include "sim/counting/stop_rule.hpp"
#include "sim/engine/checkpoint_bytes.hpp"
#include "sim/engine/measurement.hpp"
#include "sim/engine/ordered_runs.hpp"
#include "sim/threads/stopwatch.hpp"

namespace sim {

/// The first `n` runs of a shard of a point.
template <class Tally>
struct CountedRuns {
  Shard shard{};
  std::uint32_t n = 0;
  std::optional<StopReason> stop{};  // why there are no more; nothing: there are
  Tally tally{};

  template <class Archive>
  void save(Archive& archive) const {
    archive(shard.number, shard.count, n, stop ? static_cast<std::int16_t>(*stop) : unfinished,
            tally);
  }
  template <class Archive>
  void load(Archive& archive) {
    std::int16_t reason = 0;
    archive(shard.number, shard.count, n, reason, tally);
    const auto reasons = static_cast<std::int16_t>(stop_reason_names().size());
    if (reason < unfinished || reason >= reasons) throw cereal::Exception("no reason to stop");
    stop = reason == unfinished ? std::nullopt : std::optional(static_cast<StopReason>(reason));
  }

 private:
  static constexpr std::int16_t unfinished = -1;
};

/// The runs of a shard of a point: `all` of them from number `first` on, fewer where the rule has
/// enough.
struct AskedRuns {
  std::uint32_t first = 0, all = 0;
  StopRule rule{};
};

/// Seconds that the threads of a process spent in runs, added up, and how many runs they did, those
/// thrown away included.
struct RunClock {
  std::atomic<double> running_s = 0;
  std::atomic<std::uint64_t> n_runs = 0;
};

/// The smallest batch of a thread.
template <class Setup, class Tally, class Point>
std::uint32_t least_batch(const Measurement<Setup, Tally, Point>& kind, const Setup& setup,
                          std::uint32_t runs, int threads) {
  if (kind.least_at_once != nullptr) return kind.least_at_once(setup);
  return kind.most_at_once(setup, runs, threads);
}

/// Counts runs of a point that is worked out.
template <class Setup, class Tally, class Point>
class PointCounting {
 public:
  using Kind = Measurement<Setup, Tally, Point>;

  /// All must outlive this.
  PointCounting(const Kind& kind, const Setup& setup, const AskedRuns& asked, RunClock& clock)
      : kind_(kind), setup_(setup), asked_(asked), clock_(clock) {}

  /// Adds the runs to `part` that it does not have yet; fewer after an interrupt. `meanwhile` is
  /// called in this thread, some ten times a second; in a process group, behind each exchange.
  void add_to(CountedRuns<Tally>& part, const RunCounters& by,
              const std::function<void()>& meanwhile) const {
    part.stop = reason_of(part);
    if (part.stop) return;
    const Stopwatch watch;
    const double before = elapsed_of(part.tally);
    const auto take_time = [&] { set_elapsed(part.tally, before + watch.seconds()); };
    runs_behind(part, by).add_to(
        [&](RunSpan<Tally>&& span) {
          part.tally += std::move(span.tally);
          part.n += span.n;
          part.stop = reason_of(part);
          return !part.stop;
        },
        by.processes,
        [&] {
          take_time();
          if (meanwhile) meanwhile();
        });
    take_time();
  }

 private:
  OrderedRuns<Tally> runs_behind(const CountedRuns<Tally>& part, const RunCounters& by) const {
    const std::uint32_t most = kind_.most_at_once(setup_, asked_.all, by.workers.threads);
    return {{.runs = asked_.all - part.n,
             .most_at_once = most,
             .workers = by.workers,
             .first = asked_.first + part.n,
             .least_at_once = least_batch(kind_, setup_, asked_.all, by.workers.threads),
             .group = kind_.group},
            [this](std::uint32_t first, int n, const std::atomic<bool>* over) {
              const Stopwatch watch;
              Spans spans = kind_.run_groups != nullptr ? kind_.run_groups(setup_, first, n, over)
                                                        : looks(first, n, over);
              clock_.running_s += watch.seconds();
              clock_.n_runs += static_cast<std::uint64_t>(n);
              return spans;
            }};
  }

  using Spans = typename OrderedRuns<Tally>::Spans;

  /// A span for each look of the rule.
  Spans looks(std::uint32_t first, int n, const std::atomic<bool>* over) const {
    const bool has_ratio_rule = looks_at_ratio(asked_.rule);
    Spans spans;
    std::uint32_t done = first - asked_.first;
    for (const std::uint32_t end = done + static_cast<std::uint32_t>(n);
         done < end && !is_stopped(over);) {
      const std::uint32_t next = has_ratio_rule ? std::min(end, next_look(done)) : end;
      spans.push_back({next - done, kind_.run(setup_, asked_.first + done,
                                              static_cast<int>(next - done), over)});
      done = next;
    }
    return spans;
  }

  std::optional<StopReason> reason_of(const CountedRuns<Tally>& part) const {
    std::optional<StopReason> reason;
    if (part.n > 0 && (kind_.group > 1 || is_look(part.n))) reason = reason_of(part.tally);
    if (!reason && part.n >= asked_.all) reason = StopReason::max_frames;
    return reason;
  }

  std::optional<StopReason> reason_of(const Tally& tally) const {
    return stop_reason(asked_.rule,
                       {.ratio = [&](double level) { return kind_.ratio(setup_, tally, level); },
                        .loss = [&](double level) { return kind_.loss_of(setup_, tally, level); },
                        .losses = kind_.losses != nullptr ? kind_.losses(tally) : 0});
  }

  static double elapsed_of(const Tally& tally) {
    if constexpr (requires { tally.elapsed_s; })
      return tally.elapsed_s;
    else
      return 0;
  }
  static void set_elapsed(Tally& tally, double seconds) {
    if constexpr (requires { tally.elapsed_s; }) tally.elapsed_s = seconds;
  }

  const Kind& kind_;
  const Setup& setup_;
  const AskedRuns asked_;
  RunClock& clock_;
};

}  // namespace sim
