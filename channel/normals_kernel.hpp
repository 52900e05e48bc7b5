#pragma once
// The border between channel/normals.hpp and its kernels, which obeys the rules of
// channel/chain_kernel.hpp: only plain data crosses.
#include <array>
#include <cstddef>
#include <cstdint>

namespace channel {

constexpr int normals_block = 256;

struct NormalsKernelInput {
  const std::array<std::uint32_t, 4>* seeds = nullptr;  // of each lane
  float* normals = nullptr;
  std::size_t n = 0;  // whole blocks
};

void fill_lanes_baseline(const NormalsKernelInput& input);
void fill_lanes_v3(const NormalsKernelInput& input);  // x86-64-v3: AVX2 and FMA

}  // namespace channel
