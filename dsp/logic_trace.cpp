#include "dsp/logic_trace.hpp"

#include <algorithm>
#include <cassert>

namespace dsp {

void LogicTrace::flip_at(Seconds t) {
  assert(flips_.empty() || t >= flips_.back());
  if (!flips_.empty() && flips_.back() == t) {
    flips_.pop_back();
  } else {
    flips_.push_back(t);
  }
  observe_until(t);
}

void LogicTrace::set_at(Seconds t, bool level) {
  if (level != final_level()) flip_at(t);
}

void LogicTrace::observe_until(Seconds t) { end_ = std::max(end_, t); }

bool LogicTrace::level_at(Seconds t) const {
  const auto after = std::upper_bound(flips_.begin(), flips_.end(), t);
  return initial_ != ((after - flips_.begin()) % 2 == 1);
}

void TraceReader::advance_to(Seconds t) {
  const auto flips = trace_->flips();
  while (next_ < flips.size() && flips[next_] <= t) ++next_;
}

bool TraceReader::level_at(Seconds t) {
  advance_to(t);
  return trace_->initial() != (next_ % 2 == 1);
}

std::optional<Seconds> TraceReader::next_fall(Seconds t) {
  advance_to(t);
  const auto flips = trace_->flips();
  const bool high = trace_->initial() != (next_ % 2 == 1);
  if (!high && next_ > 0 && flips[next_ - 1] == t) return t;  // it falls at this very instant
  const std::size_t fall = high ? next_ : next_ + 1;
  if (fall >= flips.size()) return std::nullopt;
  return flips[fall];
}

}  // namespace dsp
