#pragma once
// Keeps what is counted while a run goes on, so that no kill loses more than some seconds of it.
#include <algorithm>
#include <chrono>
#include <functional>
#include <string>
#include <utility>

#include "sim/failure.hpp"
#include "sim/text/standard_output.hpp"

namespace sim {

/// Writes a result file, at most for a twentieth of the time.
class Checkpointer {
 public:
  /// While a point is under way: once a second, or every ten seconds where writing is slow.
  bool is_due() const {
    return Clock::now() - last_ >= std::clamp<Clock::duration>(pause_, one, ten);
  }
  /// At the end of a point: sooner.
  bool is_due_at_end() const {
    return Clock::now() - last_ >= std::min<Clock::duration>(pause_, ten);
  }

  /// Where it cannot be written at the moment, the run goes on and it is tried again.
  void keep(const std::function<void()>& write) {
    const auto began = Clock::now();
    try {
      write();
    } catch (const Failure& failure) {
      if (!std::exchange(told_, true))
        say(std::string("cosys-sim: ") + failure.what() + "; the run goes on and tries again\n");
    }
    last_ = Clock::now();
    pause_ = 20 * (last_ - began);
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::seconds one{1}, ten{10};

  Clock::time_point last_ = Clock::now();
  Clock::duration pause_{0};
  bool told_ = false;  // that it cannot be written
};

}  // namespace sim
