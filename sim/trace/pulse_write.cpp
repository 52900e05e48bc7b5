#include "sim/trace/pulse_write.hpp"

#include <cmath>
#include <ostream>
#include <vector>

namespace sim {
namespace {

long microsecond_of(dsp::Seconds t) { return std::lround(t.value * 1e6); }

/// Ticks at which light begins and ends by turns; two at one tick are none.
std::vector<long> edges_of(const dsp::LogicTrace& wire) {
  std::vector<long> edges;
  const auto add = [&](long tick) {
    if (!edges.empty() && edges.back() == tick) {
      edges.pop_back();
    } else {
      edges.push_back(tick);
    }
  };
  if (!wire.initial()) add(0);
  for (const dsp::Seconds edge : wire.edges()) add(microsecond_of(edge));
  if (edges.size() % 2 == 1) add(microsecond_of(wire.end()));
  return edges;
}

}  // namespace

void write_pulses(std::ostream& out, const dsp::LogicTrace& wire) {
  std::vector<long> edges = edges_of(wire);
  out << pulses_head << ";ook " << edges.size() / 2 << " pulses\n;freq1 0\n";
  edges.push_back(microsecond_of(wire.end()));
  for (std::size_t i = 0; i + 2 < edges.size(); i += 2)
    out << edges[i + 1] - edges[i] << ' ' << edges[i + 2] - edges[i + 1] << '\n';
  out << ";end\n";
}

}  // namespace sim
