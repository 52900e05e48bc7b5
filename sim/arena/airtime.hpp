#pragma once
// Airtime: which messages of a run light reaches the receiver of, and which of those overlap.
#include <vector>

#include "sim/arena/arena.hpp"

namespace sim {

class Airtime {
 public:
  /// `sent`: of each sender of the arena. Both must outlive this.
  Airtime(const Arena& arena, const std::vector<SentFrames>& sent);

  /// Whether the module, its slow AGC at rest, gets enough light all through the message.
  bool in_reach(std::size_t sender, const SentFrame& frame) const;

  /// Whether another sender sends at the same time, with enough light in the middle of the time
  /// that the two share.
  bool overlapped(std::size_t sender, const SentFrame& frame) const;

 private:
  struct Flight {
    dsp::Seconds start, end;
    std::size_t sender;
  };

  const Arena& arena_;
  std::vector<Flight> flights_;  // by their start
  dsp::Seconds longest_;
};

}  // namespace sim
