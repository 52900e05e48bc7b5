#pragma once
// Runs of one point, shared out to threads in batches.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "sim/threads/worker_threads.hpp"

namespace sim {

inline bool is_stopped(const std::atomic<bool>* stop) { return stop != nullptr && *stop; }

/// Who does the runs, and what ends them early.
struct Workers {
  int threads = 1;
  const std::atomic<bool>* interrupt = nullptr;

  bool interrupted() const { return is_stopped(interrupt); }
};

struct SharedRuns {
  std::uint32_t runs;
  std::uint32_t most_at_once;  // by a thread
  Workers workers;
  std::uint32_t first = 0;  // number of the first run
};

/// Result: what `n` runs from `first` on gave.
template <class Result>
class ParallelRuns {
 public:
  using Work = std::function<Result(std::uint32_t first, int n)>;
  using Take = std::function<void(Result&&, std::uint32_t n)>;

  /// A batch is as many runs as may be done at once, and not so many that threads have none.
  ParallelRuns(const SharedRuns& shared, Work work)
      : shared_(shared),
        batch_size_(
            std::clamp((shared.runs + static_cast<std::uint32_t>(shared.workers.threads) - 1) /
                           static_cast<std::uint32_t>(shared.workers.threads),
                       1U, shared.most_at_once)),
        work_(std::move(work)),
        batches_((shared.runs + batch_size_ - 1) / batch_size_) {}

  /// Gives the batches to `take` in the order of their runs, each as soon as those before it are
  /// there; after a stop up to the first that was not finished. Calls `meanwhile` after that, ten
  /// times a second at least. Both run in the calling thread. Throws what they or a thread threw.
  void in_order(
      const Take& take, const std::function<void()>& meanwhile = [] {}) {
    working_ = shared_.workers.threads;
    const auto threads = start_threads(
        shared_.workers.threads, [&] { run_batches(); }, [&] { give_up(nullptr); });
    const EndOfBatches end(*this);
    bool over = false;
    while (!over) {
      over = wait_a_moment();
      while (std::optional<Batch> batch = take_next()) take(std::move(batch->result), batch->runs);
      meanwhile();
    }
    if (error_) std::rethrow_exception(error_);
  }

  /// The batches, as in_order gives them.
  std::vector<Result> operator()() {
    std::vector<Result> finished;
    in_order([&](Result&& batch, std::uint32_t) { finished.push_back(std::move(batch)); });
    return finished;
  }

 private:
  struct Batch {
    Result result;
    std::uint32_t runs;
  };

  /// No thread begins another batch, whatever way their owner leaves.
  struct EndOfBatches {
    explicit EndOfBatches(ParallelRuns& batches) : all(batches) {}
    EndOfBatches(const EndOfBatches&) = delete;
    EndOfBatches& operator=(const EndOfBatches&) = delete;
    ~EndOfBatches() { all.give_up(nullptr); }
    ParallelRuns& all;
  };

  std::uint32_t runs_of(std::uint32_t batch) const {
    return std::min(batch_size_, shared_.runs - batch * batch_size_);
  }

  void run_batches() {
    while (const auto batch = next()) {
      try {
        finish(*batch,
               work_(shared_.first + *batch * batch_size_, static_cast<int>(runs_of(*batch))));
      } catch (...) {
        give_up(std::current_exception());
      }
    }
    const std::scoped_lock lock(mutex_);
    --working_;
    changed_.notify_one();
  }

  std::optional<std::uint32_t> next() {
    const std::scoped_lock lock(mutex_);
    if (next_ >= batches_.size() || shared_.workers.interrupted()) return std::nullopt;
    return next_++;
  }

  void finish(std::uint32_t batch, Result result) {
    if (shared_.workers.interrupted()) return;
    const std::scoped_lock lock(mutex_);
    batches_[batch] = std::move(result);
    if (batch == taken_) changed_.notify_one();
  }

  bool is_next_finished() const { return taken_ < batches_.size() && batches_[taken_].has_value(); }

  /// Until a batch can be taken, or all threads are done (true).
  bool wait_a_moment() {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, std::chrono::milliseconds(100),
                      [this] { return working_ == 0 || is_next_finished(); });
    return working_ == 0;
  }

  std::optional<Batch> take_next() {
    const std::scoped_lock lock(mutex_);
    if (!is_next_finished()) return std::nullopt;
    Batch batch{*std::exchange(batches_[taken_], std::nullopt), runs_of(taken_)};
    ++taken_;
    return batch;
  }

  void give_up(const std::exception_ptr& error) {
    const std::scoped_lock lock(mutex_);
    if (!error_) error_ = error;
    next_ = static_cast<std::uint32_t>(batches_.size());
  }

  SharedRuns shared_;
  std::uint32_t batch_size_;
  Work work_;
  std::vector<std::optional<Result>> batches_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::uint32_t next_ = 0;   // batch to be begun next
  std::uint32_t taken_ = 0;  // batches that were given away
  int working_ = 0;          // threads
  std::exception_ptr error_;
};

}  // namespace sim
