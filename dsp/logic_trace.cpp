#include "dsp/logic_trace.hpp"

#include <algorithm>
#include <cassert>

namespace dsp {

void LogicTrace::add_edge(Seconds t) {
  assert(edges_.empty() || t >= edges_.back());
  if (!edges_.empty() && edges_.back() == t) {
    edges_.pop_back();
  } else {
    edges_.push_back(t);
  }
  observe_until(t);
}

void LogicTrace::set_at(Seconds t, bool level) {
  if (level != final_level()) add_edge(t);
}

void LogicTrace::observe_until(Seconds t) { end_ = std::max(end_, t); }

bool LogicTrace::level_at(Seconds t) const {
  const auto after = std::upper_bound(edges_.begin(), edges_.end(), t);
  return initial_ != ((after - edges_.begin()) % 2 == 1);
}

void TraceReader::advance_to(Seconds t) {
  const auto edges = trace_->edges();
  while (next_ < edges.size() && edges[next_] <= t) ++next_;
}

bool TraceReader::level_at(Seconds t) {
  advance_to(t);
  return trace_->initial() != (next_ % 2 == 1);
}

std::optional<Seconds> TraceReader::next_fall(Seconds t) {
  advance_to(t);
  const auto edges = trace_->edges();
  const bool high = trace_->initial() != (next_ % 2 == 1);
  if (!high && next_ > 0 && edges[next_ - 1] == t) return t;  // it falls at this very instant
  const std::size_t fall = high ? next_ : next_ + 1;
  if (fall >= edges.size()) return std::nullopt;
  return edges[fall];
}

}  // namespace dsp
