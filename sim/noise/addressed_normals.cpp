#include "sim/noise/addressed_normals.hpp"

#include "channel/normals.hpp"

namespace sim {

std::vector<float> addressed_normals(const dsp::RandomAddress& draws, std::size_t n) {
  channel::StreamSeeds seeds;
  for (std::size_t i = 0; i < seeds.size(); ++i)
    seeds[i] = draws.block(static_cast<std::uint32_t>(i));
  return channel::draw_normals(seeds, n);
}

}  // namespace sim
