#include "sim/engine/group_engine.hpp"

#include <algorithm>
#include <exception>
#include <mutex>
#include <optional>
#include <vector>

#include "channel/instruction_set.hpp"
#include "sim/counting/shard.hpp"
#include "sim/engine/batch_sizes.hpp"
#include "sim/engine/process_group.hpp"
#include "sim/threads/stopwatch.hpp"
#include "sim/threads/worker_threads.hpp"

namespace sim {
namespace {

constexpr std::uint64_t largest_wave = 1 << 16;  // groups of a member

/// Groups of a thread in the shortest wave: as many as the widest processors have lanes for, since
/// the members must agree and their processors may differ.
constexpr std::uint64_t least_share = channel::most_lanes / group_size;

/// What all members run between two exchanges, each its share of groups, in the order of the ranks.
struct Wave {
  std::uint64_t first, share;  // groups
  std::uint64_t end_trial;     // of the point; groups behind it are empty

  /// Trials among some groups.
  int trials_in(std::uint64_t group, std::uint64_t groups) const {
    const std::uint64_t left = end_trial - std::min(end_trial, group * group_size);
    return static_cast<int>(std::min(groups * group_size, left));
  }
};

/// Batches of a thread, all alike.
std::uint64_t batch_size(const BatchSizes& sizes, std::uint64_t share, std::uint64_t threads) {
  const std::uint64_t rounds = divided_up(share, sizes.most * threads);
  return divided_up(divided_up(share, rounds * threads), sizes.least) * sizes.least;
}

/// Runs a member's share of a wave on some threads.
class WaveRun {
 public:
  WaveRun(const Link& link, const Wave& wave, std::uint64_t rank, const EngineOptions& options)
      : link_(link),
        wave_(wave),
        first_(wave.first + rank * wave.share),
        batch_(
            batch_size(batch_sizes(link), wave.share, static_cast<std::uint64_t>(options.threads))),
        options_(options),
        results_(wave.share) {}

  std::vector<GroupResult> run() {
    start_threads(
        options_.threads, [this] { work(); }, [this] { next_ = wave_.share; })
        .clear();  // waits for them
    if (failure_) std::rethrow_exception(failure_);
    return std::move(results_);
  }

 private:
  void work() {
    try {
      for (std::uint64_t i = next_ += batch_; i - batch_ < wave_.share; i = next_ += batch_)
        run_batch(i - batch_);
    } catch (...) {
      const std::lock_guard lock(mutex_);
      failure_ = std::current_exception();
    }
  }

  void run_batch(std::uint64_t i) {
    const std::uint64_t group = first_ + i;
    const int n = wave_.trials_in(group, std::min(batch_, wave_.share - i));
    if (n == 0) return;
    std::ranges::move(run_groups(link_, static_cast<std::uint32_t>(group * group_size), n,
                                 options_.interrupt, options_.profiled),
                      results_.data() + i);
  }

  const Link& link_;
  const Wave wave_;
  const std::uint64_t first_, batch_;  // groups
  const EngineOptions& options_;
  std::atomic<std::uint64_t> next_ = 0;
  std::vector<GroupResult> results_;
  std::mutex mutex_;
  std::exception_ptr failure_;
};

/// Adds what all members ran in the order of the trials, up to where the rule stops.
std::optional<StopReason> add_in_order(const std::vector<GroupResult>& all, const StopRule& rule,
                                       GroupResult& sum) {
  for (const GroupResult& group : all) {
    sum += group;
    if (const auto reason = stop_reason(rule, sum.tally)) return reason;
  }
  return std::nullopt;
}

/// The share of the next wave, at most what is left for all.
std::uint64_t share_behind(const Wave& done, std::uint64_t members, double seconds) {
  const std::uint64_t share = next_share(done.share, seconds, least_share, largest_wave);
  const std::uint64_t next = done.first + done.share * members;
  const std::uint64_t left = divided_up(done.end_trial, group_size) - next;
  return std::min(share, divided_up(left, members));
}

}  // namespace

PointResult run_point_together(const Link& link, const StopRule& stop, const EngineOptions& options,
                               const PointResult& before) {
  ProcessGroup& processes = *options.processes;
  const Stopwatch watch;
  const auto point = [&](const GroupResult& counted, StopReason reason) {
    return as_point(counted, reason, link, before.elapsed_s + watch.seconds());
  };
  const auto members = static_cast<std::uint64_t>(processes.size());
  const auto rank = static_cast<std::uint64_t>(processes.rank());
  GroupResult sum{before.tally, before.simulated_s, before.n_samples, before.profile};
  Wave wave{(options.first_trial + sum.tally.n_frames) / group_size,
            least_share * static_cast<std::uint64_t>(processes.largest(options.threads)),
            options.first_trial + stop.max_frames};
  for (;;) {
    const Stopwatch wave_watch;
    const auto mine = WaveRun(link, wave, rank, options).run();
    const double seconds = processes.largest(wave_watch.seconds());
    if (processes.any(options.interrupt != nullptr && *options.interrupt))
      return point(sum, StopReason::interrupted);
    const auto reason = add_in_order(processes.exchange(mine), stop, sum);
    if (reason) return point(sum, *reason);
    if (options.on_progress) options.on_progress(point(sum, StopReason::interrupted));
    const std::uint64_t share = share_behind(wave, members, seconds);
    wave.first += wave.share * members;
    wave.share = share;
  }
}

}  // namespace sim
