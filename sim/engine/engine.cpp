#include "sim/engine/engine.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "sim/engine/batch_sizes.hpp"
#include "sim/engine/group_engine.hpp"
#include "sim/threads/stopwatch.hpp"
#include "sim/threads/worker_threads.hpp"
#include "sim/trial/trial.hpp"

namespace sim {
namespace {

/// Single groups where else threads would have nothing to do.
BatchSizes sizes_for(const Link& link, std::uint64_t groups, int threads) {
  const BatchSizes sizes = batch_sizes(link);
  return groups < sizes.least * static_cast<std::uint64_t>(threads) ? BatchSizes{1, 1} : sizes;
}

/// What the workers of one point share.
class Pool {
 public:
  Pool(const Link& link, const StopRule& stop, const EngineOptions& options,
       const PointResult& before)
      : link_(link),
        rule_(stop),
        profiled_(options.profiled),
        end_(options.first_trial + stop.max_frames),
        threads_(static_cast<std::uint64_t>(options.threads)),
        sizes_(sizes_for(link, stop.max_frames / group_size, options.threads)),
        ahead_(4 * sizes_.most * threads_),
        first_((options.first_trial + before.tally.n_frames) / group_size),
        next_(first_),
        merged_(first_),
        sum_{before.tally, before.simulated_s, before.n_samples, before.profile},
        over_(next_ * group_size >= end_) {}

  void work() {
    while (const auto batch = take()) {
      try {
        give(batch->first, run_batch(*batch));
      } catch (...) {
        fail(std::current_exception());
      }
    }
  }

  /// Waits for the end or a moment; true at the end.
  bool wait_a_moment() {
    std::unique_lock lock(mutex_);
    ended_.wait_for(lock, std::chrono::milliseconds(100), [this] { return over_.load(); });
    return over_;
  }

  void interrupt() { end(StopReason::interrupted); }

  GroupResult sum() {
    const std::lock_guard lock(mutex_);
    return sum_;
  }

  /// To be called when all workers are done.
  StopReason result() {
    if (failure_) std::rethrow_exception(failure_);
    return reason_;
  }

 private:
  /// Groups first ... first + n - 1, the last of which may be smaller.
  struct Batch {
    std::uint64_t first, n;
  };

  std::vector<GroupResult> run_batch(const Batch& batch) {
    const std::uint64_t trial = batch.first * group_size;
    const auto n = static_cast<int>(std::min(batch.n * group_size, end_ - trial));
    return run_groups(link_, static_cast<std::uint32_t>(trial), n, &over_, profiled_);
  }

  /// The next batch to run, not too far ahead of the sum.
  std::optional<Batch> take() {
    std::unique_lock lock(mutex_);
    room_.wait(lock, [this] { return over_ || next_ < merged_ + ahead_; });
    if (over_ || next_ * group_size >= end_) return std::nullopt;
    const std::uint64_t n = next_size();
    return Batch{std::exchange(next_, next_ + n), n};
  }

  /// Small at first, as the rule may soon stop, and at last, so that threads are done together.
  std::uint64_t next_size() const {
    const std::uint64_t done = next_ - first_, left = (end_ - next_ * group_size) / group_size;
    const std::uint64_t n = std::min(done, left) / (2 * threads_);
    return std::clamp(n - n % sizes_.least, sizes_.least, sizes_.most);
  }

  void give(std::uint64_t first, std::vector<GroupResult> results) {
    const std::lock_guard lock(mutex_);
    waiting_[first] = std::move(results);
    while (!over_ && waiting_.contains(merged_)) {
      const auto batch = waiting_.extract(merged_);
      add(batch.mapped());
      merged_ += batch.mapped().size();
    }
    room_.notify_all();
    if (over_) ended_.notify_all();
  }

  /// Adds groups in the order of their numbers, up to where the rule stops.
  void add(const std::vector<GroupResult>& results) {
    for (const GroupResult& result : results) {
      sum_ += result;
      const auto reason = stop_reason(rule_, sum_.tally);
      if (!reason) continue;
      over_ = true;
      reason_ = *reason;
      return;
    }
  }

  void end(StopReason reason) {
    const std::lock_guard lock(mutex_);
    if (!over_) reason_ = reason;
    over_ = true;
    room_.notify_all();
    ended_.notify_all();
  }

  void fail(std::exception_ptr failure) {
    end(StopReason::interrupted);
    const std::lock_guard lock(mutex_);
    if (!failure_) failure_ = std::move(failure);
  }

  const Link& link_;
  const StopRule rule_;
  const bool profiled_;
  const std::uint64_t end_;  // of the trials
  const std::uint64_t threads_;
  const BatchSizes sizes_;
  const std::uint64_t ahead_;
  const std::uint64_t first_;  // group of this run

  std::mutex mutex_;
  std::condition_variable room_;   // for further groups, or the point is over
  std::condition_variable ended_;  // the point is over: to be heard apart, not at each group
  std::uint64_t next_;             // group to be taken next
  std::uint64_t merged_;           // groups in the sum
  std::map<std::uint64_t, std::vector<GroupResult>> waiting_;  // by the first of their groups
  GroupResult sum_;
  std::atomic<bool> over_;  // written under the mutex; groups under way look at it
  StopReason reason_ = StopReason::max_frames;
  std::exception_ptr failure_;
};

/// The threads of a pool, which end soon whatever way their owner leaves.
class PoolThreads {
 public:
  PoolThreads(Pool& pool, int threads)
      : pool_(pool),
        threads_(start_threads(
            threads, [&pool] { pool.work(); }, [&pool] { pool.interrupt(); })) {}
  PoolThreads(const PoolThreads&) = delete;
  PoolThreads& operator=(const PoolThreads&) = delete;
  ~PoolThreads() { pool_.interrupt(); }

 private:
  Pool& pool_;
  std::vector<std::jthread> threads_;
};

}  // namespace

PointResult run_point(const Link& link, const StopRule& stop, const EngineOptions& options,
                      const PointResult& before) {
  if (options.processes != nullptr) return run_point_together(link, stop, options, before);
  const Stopwatch watch;
  const auto elapsed_s = [&] { return before.elapsed_s + watch.seconds(); };
  Pool pool(link, stop, options, before);
  {
    const PoolThreads threads(pool, options.threads);
    while (!pool.wait_a_moment()) {
      if (options.interrupt != nullptr && *options.interrupt) pool.interrupt();
      if (options.on_progress)
        options.on_progress(as_point(pool.sum(), StopReason::interrupted, link, elapsed_s()));
    }
  }
  const StopReason reason = pool.result();
  return as_point(pool.sum(), reason, link, elapsed_s());
}

bool is_resumable(const PointResult& point) { return point.tally.n_frames % group_size == 0; }

int threads_for(int asked) {
  if (asked > 0) return asked;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

}  // namespace sim
