#pragma once
// Runs of one point, shared out to threads by the lot.
#include <algorithm>
#include <atomic>
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
};

/// Result: what runs first ... first + n - 1 gave.
template <class Result>
class RunSharing {
 public:
  using Work = std::function<Result(std::uint32_t first, int n)>;

  /// A lot is as many runs as may be done at once, and not so many that threads have none.
  RunSharing(const SharedRuns& shared, Work work)
      : shared_(shared),
        lot_(std::clamp((shared.runs + static_cast<std::uint32_t>(shared.workers.threads) - 1) /
                            static_cast<std::uint32_t>(shared.workers.threads),
                        1U, shared.most_at_once)),
        work_(std::move(work)),
        lots_((shared.runs + lot_ - 1) / lot_) {}

  /// The lots in the order of their runs; after a stop those up to the first that was not finished.
  /// Throws what a thread threw.
  std::vector<Result> operator()() {
    start_threads(
        shared_.workers.threads, [&] { run_lots(); }, [&] { give_up(nullptr); })
        .clear();  // waits for them
    if (error_) std::rethrow_exception(error_);
    std::vector<Result> finished;
    for (std::optional<Result>& lot : lots_) {
      if (!lot) break;
      finished.push_back(std::move(*lot));
    }
    return finished;
  }

 private:
  void run_lots() {
    while (const auto lot = next()) {
      try {
        const std::uint32_t first = *lot * lot_;
        Result result = work_(first, static_cast<int>(std::min(lot_, shared_.runs - first)));
        if (!shared_.workers.interrupted()) lots_[*lot] = std::move(result);
      } catch (...) {
        give_up(std::current_exception());
      }
    }
  }

  std::optional<std::uint32_t> next() {
    const std::scoped_lock lock(mutex_);
    if (next_ >= lots_.size() || shared_.workers.interrupted()) return std::nullopt;
    return next_++;
  }

  void give_up(const std::exception_ptr& error) {
    const std::scoped_lock lock(mutex_);
    if (!error_) error_ = error;
    next_ = static_cast<std::uint32_t>(lots_.size());
  }

  SharedRuns shared_;
  std::uint32_t lot_;
  Work work_;
  std::vector<std::optional<Result>> lots_;
  std::mutex mutex_;
  std::uint32_t next_ = 0;
  std::exception_ptr error_;
};

}  // namespace sim
