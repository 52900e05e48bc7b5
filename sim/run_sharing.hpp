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

#include "channel/instruction_set.hpp"
#include "sim/worker_threads.hpp"

namespace sim {

/// Result: what runs first ... first + n - 1 gave.
template <class Result>
class RunSharing {
 public:
  using Work = std::function<Result(std::uint32_t first, int n)>;

  /// A lot is as many runs as there are lanes, and not so many that threads have none.
  RunSharing(std::uint32_t runs, int threads, const std::atomic<bool>* stop, Work work)
      : runs_(runs),
        threads_(threads),
        lot_(std::clamp(
            (runs + static_cast<std::uint32_t>(threads) - 1) / static_cast<std::uint32_t>(threads),
            1U, static_cast<std::uint32_t>(channel::trials_at_once()))),
        stop_(stop),
        work_(std::move(work)),
        lots_((runs + lot_ - 1) / lot_) {}

  /// The lots in the order of their runs; nothing if it was stopped. Throws what a thread threw.
  std::optional<std::vector<Result>> operator()() {
    start_threads(
        threads_, [&] { run_lots(); }, [&] { give_up(nullptr); })
        .clear();  // waits for them
    if (error_) std::rethrow_exception(error_);
    if (stopped()) return std::nullopt;
    return std::move(lots_);
  }

 private:
  bool stopped() const { return stop_ != nullptr && *stop_; }

  void run_lots() {
    while (const auto lot = next()) {
      try {
        const std::uint32_t first = *lot * lot_;
        lots_[*lot] = work_(first, static_cast<int>(std::min(lot_, runs_ - first)));
      } catch (...) {
        give_up(std::current_exception());
      }
    }
  }

  std::optional<std::uint32_t> next() {
    const std::scoped_lock lock(mutex_);
    if (next_ >= lots_.size() || stopped()) return std::nullopt;
    return next_++;
  }

  void give_up(const std::exception_ptr& error) {
    const std::scoped_lock lock(mutex_);
    if (!error_) error_ = error;
    next_ = static_cast<std::uint32_t>(lots_.size());
  }

  std::uint32_t runs_;
  int threads_;
  std::uint32_t lot_;
  const std::atomic<bool>* stop_;
  Work work_;
  std::vector<Result> lots_;
  std::mutex mutex_;
  std::uint32_t next_ = 0;
  std::exception_ptr error_;
};

}  // namespace sim
