#pragma once
// Standard normals of an address, in bulk: channel/normals seeded by the address's first blocks.
#include <cstddef>
#include <vector>

#include "dsp/philox.hpp"

namespace sim {

/// At least `n` of them.
std::vector<float> addressed_normals(const dsp::RandomAddress& draws, std::size_t n);

}  // namespace sim
