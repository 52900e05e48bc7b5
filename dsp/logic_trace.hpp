#pragma once
// LogicTrace: the level of one wire over time, the only type that channel and protocol share.
// What a UART drives into an LED and what a receiver module gives the RX pin are both one of these,
// so a perfect link is the identity plus a delay. Edge times must not decrease.
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "dsp/units.hpp"

namespace dsp {

class LogicTrace {
 public:
  /// A wire at `initial` level that never changes, observed until `end`.
  explicit LogicTrace(bool initial = true, Seconds end = Seconds(0))
      : initial_(initial), end_(end) {}

  /// The level changes at `t` (not before the last edge). Two edges at one instant cancel.
  void add_edge(Seconds t);
  /// Makes the level `level` from `t` on; does nothing if it is so already.
  void set_at(Seconds t, bool level);
  /// Extends the observation to `t`; it never shrinks and always covers the last edge.
  void observe_until(Seconds t);

  bool initial() const { return initial_; }
  bool final_level() const { return initial_ != (edges_.size() % 2 == 1); }
  /// Level at `t`; an instant that is an edge has the level after it. O(log n).
  bool level_at(Seconds t) const;
  std::span<const Seconds> edges() const { return edges_; }
  Seconds end() const { return end_; }

  bool operator==(const LogicTrace&) const = default;

 private:
  bool initial_;
  Seconds end_;
  std::vector<Seconds> edges_;
};

/// Reads a trace forward in time in amortised O(1) a question: what a receiver's clock does.
class TraceReader {
 public:
  explicit TraceReader(const LogicTrace& trace) : trace_(&trace) {}
  /// Level at `t`. Times asked must not decrease.
  bool level_at(Seconds t);
  /// First instant at or after `t` at which the wire falls (1 to 0). Times asked must not decrease.
  std::optional<Seconds> next_fall(Seconds t);

 private:
  void advance_to(Seconds t);

  const LogicTrace* trace_;
  std::size_t next_ = 0;  // index of the first edge after the last time asked
};

}  // namespace dsp
