#pragma once
// PacedOutput: messages on their way out, byte by byte at the pace of a line of so many bits per
// second, by absolute deadlines: a pseudo-terminal would take all of them at once. A port that
// takes no more is tried again; meanwhile messages that have not begun can be dropped whole.
#include <cstddef>
#include <cstdint>
#include <span>

#include "dsp/units.hpp"
#include "protocol/uart.hpp"

namespace sim {

class PacedOutput {
 public:
  explicit PacedOutput(dsp::Hertz baud);

  bool is_empty() const { return at_ == bytes_.size(); }
  /// The port took less than was due, the last time.
  bool is_stuck() const { return stuck_; }
  /// Whole messages, each ending in a newline.
  void push(const protocol::Bytes& messages, dsp::Seconds now);
  /// The bytes that the line has room for by now.
  std::span<const std::uint8_t> due(dsp::Seconds now) const;
  /// So many of the due bytes were taken.
  void take(std::size_t bytes, dsp::Seconds now);
  /// When there will be due bytes, if it is not empty.
  dsp::Seconds next() const { return free_at_; }
  /// Drops all messages but one that has begun; how many.
  std::size_t drop_unbegun();

 private:
  dsp::Seconds byte_time_;
  protocol::Bytes bytes_;
  std::size_t at_ = 0;  // of the next byte
  dsp::Seconds free_at_;
  bool stuck_ = false, begun_ = false;
};

}  // namespace sim
