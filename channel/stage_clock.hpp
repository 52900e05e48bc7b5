#pragma once
// Where the time of a chain goes, stage by stage. Looking at a clock behind each loop costs time
// itself, so it is done only where somebody asks.
#include <array>
#include <chrono>
#include <cstddef>

#include "channel/chain_kernel.hpp"

namespace channel {

class StageClock {
 public:
  /// Wall-clock seconds of this thread, by ChainStage.
  using Seconds = std::array<double, chain_stages>;

  void start() { last_ = Clock::now(); }
  const Seconds& seconds() const { return seconds_; }

  /// For ChainKernelInput::on_stage; `self` is the clock.
  static void lap(void* self, ChainStage done) { static_cast<StageClock*>(self)->lap(done); }

 private:
  using Clock = std::chrono::steady_clock;

  void lap(ChainStage done) {
    const Clock::time_point now = Clock::now();
    seconds_[static_cast<std::size_t>(done)] += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }

  Clock::time_point last_{};
  Seconds seconds_{};
};

}  // namespace channel
