#include "sim/arena/airtime.hpp"

#include <algorithm>

namespace sim {

using dsp::Seconds;

Airtime::Airtime(const Arena& arena, const std::vector<SentFrames>& sent) : arena_(arena) {
  for (std::size_t i = 0; i < sent.size(); ++i)
    for (const SentFrame& frame : sent[i].frames) {
      if (frame.silent) continue;
      flights_.push_back({frame.start, frame.end, i});
      longest_ = std::max(longest_, frame.end - frame.start);
    }
  std::ranges::sort(flights_, {}, &Flight::start);
}

bool Airtime::in_reach(std::size_t sender, const SentFrame& frame) const {
  const LightTrack& light = arena_.light[sender];
  double least = std::min(light.at(frame.start), light.at(frame.end));
  for (Seconds t = frame.start; t < frame.end; t += light.step)
    least = std::min(least, light.at(t));
  return least >= arena_.reach_mw_per_m2;
}

bool Airtime::overlapped(std::size_t sender, const SentFrame& frame) const {
  auto other = std::ranges::lower_bound(flights_, frame.start - longest_, {}, &Flight::start);
  for (; other != flights_.end() && other->start < frame.end; ++other) {
    if (other->sender == sender || other->end <= frame.start) continue;
    const Seconds from = std::max(frame.start, other->start), to = std::min(frame.end, other->end);
    if (arena_.light[other->sender].at((from + to) * 0.5) >= arena_.reach_mw_per_m2) return true;
  }
  return false;
}

}  // namespace sim
