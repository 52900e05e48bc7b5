#pragma once
// LinePlayer: bytes of a line in their order, each not before its instant on the line's own clock.
// It knows no other clock and no port, so what it plays is the same at any speed.
#include <deque>
#include <limits>

#include "dsp/units.hpp"
#include "protocol/uart.hpp"
#include "sim/serve/line_message.hpp"

namespace sim {

class LinePlayer {
 public:
  /// The bytes of a message whose time 0 is at `origin`, behind all pushed before.
  void push(const LineMessage& message, dsp::Seconds origin);
  /// When the next byte is due; infinitely late if there is none.
  dsp::Seconds next() const;
  /// Those that are due by now, once.
  protocol::Bytes take_due(dsp::Seconds now);

 private:
  std::deque<LineByte> waiting_;  // `at` on the line's clock
};

}  // namespace sim
