#include "sim/capture/logic_capture.hpp"

#include <utility>

namespace sim {

using dsp::LogicTrace;
using dsp::Seconds;

WireEdges::WireEdges(LogicCapture& capture, std::size_t wire) : capture_(capture), wire_(wire) {
  read_initial();
}

void WireEdges::read_initial() {
  while (const auto change = capture_.next()) {
    if (change->wire != wire_) continue;
    level_ = change->level;
    if (change->initial) {
      initial_ = level_;
    } else if (!level_) {
      held_ = change->at;
    }
    return;
  }
}

std::optional<Seconds> WireEdges::next() {
  while (const auto change = capture_.next()) {
    if (change->wire != wire_ || change->level == level_) continue;
    level_ = change->level;
    if (held_ == change->at) {
      held_.reset();
    } else if (const auto edge = std::exchange(held_, change->at)) {
      return edge;
    }
  }
  return std::exchange(held_, std::nullopt);
}

Seconds WireEdges::known_until() const { return held_.value_or(capture_.now()); }

std::vector<NamedTrace> read_whole(LogicCapture& capture) {
  std::vector<std::optional<LogicTrace>> traces(capture.wires().size());
  while (const auto change = capture.next()) {
    std::optional<LogicTrace>& trace = traces[change->wire];
    if (!trace) trace.emplace(change->initial ? change->level : true);
    trace->set_at(change->at, change->level);
  }
  std::vector<NamedTrace> named;
  for (std::size_t i = 0; i < traces.size(); ++i) {
    named.push_back({capture.wires()[i], std::move(traces[i]).value_or(LogicTrace(true))});
    named.back().trace.observe_until(capture.now());
  }
  return named;
}

}  // namespace sim
