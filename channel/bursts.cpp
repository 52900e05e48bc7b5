#include "channel/bursts.hpp"

namespace channel {

std::vector<Burst> bursts_of(const dsp::LogicTrace& drive, dsp::Hertz sample_rate) {
  std::vector<Burst> bursts;
  bursts.reserve(drive.edges().size() / 2 + 1);
  bool lit = !drive.initial();
  double since = 0;
  for (const dsp::Seconds edge : drive.edges()) {
    const double at = edge_at(dsp::cycles(edge, sample_rate));
    if (lit) bursts.push_back({since, at});
    lit = !lit;
    since = at;
  }
  if (lit) bursts.push_back({since, edge_at(dsp::cycles(drive.end(), sample_rate))});
  return bursts;
}

}  // namespace channel
