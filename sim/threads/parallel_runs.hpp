#pragma once
// Runs of one point, shared out to threads in batches.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <concepts>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "sim/threads/worker_threads.hpp"

namespace sim {

inline bool is_stopped(const std::atomic<bool>* stop) { return stop != nullptr && *stop; }

/// Who does the runs, what ends them early, and whether they time their stages.
struct Workers {
  int threads = 1;
  const std::atomic<bool>* interrupt = nullptr;
  bool profiled = false;

  bool interrupted() const { return is_stopped(interrupt); }
};

/// How many shares of `b` it takes to hold `a`.
template <std::unsigned_integral T>
constexpr T divided_up(T a, T b) {
  return (a + b - 1) / b;
}

struct SharedRuns {
  std::uint32_t runs;
  std::uint32_t most_at_once;  // by a thread
  Workers workers;
  std::uint32_t first = 0;  // number of the first run
  /// Fewer than most_at_once: batches are small at first and at last, where the sum may soon be
  /// enough, or threads shall end together.
  std::uint32_t least_at_once = most_at_once;
  std::uint32_t group = 1;  // a batch is whole groups, but for the last run's
};

/// Result: what some runs gave.
template <class Result>
class ParallelRuns {
 public:
  /// Does `n` runs from `first` on. Its result is dropped once `*over` is true.
  using Work = std::function<Result(std::uint32_t first, int n, const std::atomic<bool>* over)>;
  /// Whether more runs are wanted.
  using Take = std::function<bool(Result&&, std::uint32_t n)>;

  /// No batch has so many runs that threads have none.
  ParallelRuns(const SharedRuns& shared, Work work)
      : shared_(shared),
        threads_(static_cast<std::uint32_t>(shared.workers.threads)),
        work_(std::move(work)) {
    const std::uint32_t share = divided_up(divided_up(shared.runs, threads_), shared.group);
    shared_.most_at_once = std::clamp(share * shared.group, 1U, shared.most_at_once);
    shared_.least_at_once = std::min(shared.least_at_once, shared_.most_at_once);
  }

  /// Gives the results to `take` in the order of their runs, each as soon as those before it are
  /// there: all; or up to the first that was not finished when an interrupt came; or up to the one
  /// behind which no more are wanted. Calls `meanwhile` some ten times a second from the calling
  /// thread. Neither is called while the other runs; `take` is called from any thread. Throws what
  /// they or the work threw.
  void in_order(
      const Take& take, const std::function<void()>& meanwhile = [] {}) {
    working_ = threads_;
    {
      const auto threads = start_threads(
          shared_.workers.threads, [&] { run_batches(take); }, [&] { end(); });
      const EndOfBatches end_of_batches(*this);
      while (!wait_a_moment()) {
        if (shared_.workers.interrupted()) end();
        if (const std::scoped_lock lock(taking_); !has_failed()) meanwhile();
        give_finished(take);
      }
    }
    give_finished(take);
    if (error_) std::rethrow_exception(error_);
  }

  /// The results, as in_order gives them.
  std::vector<Result> operator()() {
    std::vector<Result> finished;
    in_order([&](Result&& batch, std::uint32_t) {
      finished.push_back(std::move(batch));
      return true;
    });
    return finished;
  }

 private:
  struct Batch {
    std::uint32_t first, runs;
    std::optional<Result> result{};
  };

  /// No thread begins another batch, whatever way their owner leaves.
  struct EndOfBatches {
    explicit EndOfBatches(ParallelRuns& batches) : all(batches) {}
    EndOfBatches(const EndOfBatches&) = delete;
    EndOfBatches& operator=(const EndOfBatches&) = delete;
    ~EndOfBatches() { all.end(); }
    ParallelRuns& all;
  };

  void run_batches(const Take& take) {
    while (Batch* batch = next()) {
      try {
        finish(*batch, work_(shared_.first + batch->first, static_cast<int>(batch->runs), &over_));
      } catch (...) {
        fail(std::current_exception());
      }
      give_finished(take);
    }
    const std::scoped_lock lock(mutex_);
    --working_;
    ended_.notify_one();
  }

  /// The next batch to be run, not too far ahead of those that were taken; null: there is none.
  Batch* next() {
    std::unique_lock lock(mutex_);
    const std::uint64_t ahead = std::uint64_t{16} * shared_.most_at_once * threads_;
    room_.wait(lock, [&] { return over_ || begun_ < taken_ + ahead; });
    if (over_ || shared_.workers.interrupted() || begun_ == shared_.runs) return nullptr;
    Batch& batch = batches_.emplace_back(Batch{begun_, next_size()});
    begun_ += batch.runs;
    return &batch;
  }

  std::uint32_t next_size() const {
    const std::uint32_t left = shared_.runs - begun_;
    const std::uint32_t n = std::min(begun_, left) / (2 * threads_);
    return std::min(
        std::clamp(n - n % shared_.least_at_once, shared_.least_at_once, shared_.most_at_once),
        left);
  }

  void finish(Batch& batch, Result result) {
    const std::scoped_lock lock(mutex_);
    if (!over_ && !shared_.workers.interrupted()) batch.result = std::move(result);
  }

  /// Unless another thread does, which then also gives what was finished meanwhile.
  void give_finished(const Take& take) {
    while (is_next_finished()) {
      const std::unique_lock taking(taking_, std::try_to_lock);
      if (!taking) return;
      take_finished(take);
    }
  }

  /// What `take` throws ends the taking before another thread may go on with it.
  void take_finished(const Take& take) {
    try {
      while (std::optional<Batch> batch = take_next())
        if (!take(std::move(*batch->result), batch->runs)) take_no_more();
    } catch (...) {
      fail(std::current_exception());
    }
  }

  bool is_next_finished() {
    const std::scoped_lock lock(mutex_);
    return is_next_there();
  }
  bool is_next_there() const {
    return !is_enough_ && !batches_.empty() && batches_.front().result.has_value();
  }

  std::optional<Batch> take_next() {
    const std::scoped_lock lock(mutex_);
    if (!is_next_there()) return std::nullopt;
    std::optional<Batch> batch(std::move(batches_.front()));
    batches_.pop_front();
    taken_ += batch->runs;
    room_.notify_all();
    return batch;
  }

  /// Until all threads are done (true), or a tenth of a second.
  bool wait_a_moment() {
    std::unique_lock lock(mutex_);
    return ended_.wait_for(lock, std::chrono::milliseconds(100), [this] { return working_ == 0; });
  }

  void end() {
    const std::scoped_lock lock(mutex_);
    over_ = true;
    room_.notify_all();
  }

  bool has_failed() {
    const std::scoped_lock lock(mutex_);
    return error_ != nullptr;
  }

  void take_no_more() {
    end();
    const std::scoped_lock lock(mutex_);
    is_enough_ = true;
  }

  void fail(const std::exception_ptr& error) {
    take_no_more();
    const std::scoped_lock lock(mutex_);
    if (!error_) error_ = error;
  }

  SharedRuns shared_;
  std::uint32_t threads_;
  Work work_;
  std::mutex taking_;  // held by the thread that gives results away, or calls `meanwhile`
  std::mutex mutex_;   // of all below
  std::condition_variable room_;    // for further batches, or it is over
  std::condition_variable ended_;   // all threads
  std::deque<Batch> batches_;       // begun and not taken, in the order of their runs
  std::uint32_t begun_ = 0;         // runs
  std::uint64_t taken_ = 0;         // runs
  std::uint32_t working_ = 0;       // threads
  std::atomic<bool> over_ = false;  // written under the mutex; batches under way look at it
  bool is_enough_ = false;          // no more results are wanted
  std::exception_ptr error_;
};

}  // namespace sim
