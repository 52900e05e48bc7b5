#pragma once
// White noise in bulk, outside of a chain: standard normals (dsp/normal.hpp), eight streams dealt
// out in turn. The same for all instruction sets.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "channel/instruction_set.hpp"

namespace channel {

constexpr int normal_streams = 8;
using StreamSeeds = std::array<std::array<std::uint32_t, 4>, normal_streams>;

/// At least `n` of them.
std::vector<float> draw_normals(const StreamSeeds& seeds, std::size_t n,
                                InstructionSet set = InstructionSet::best);

}  // namespace channel
