#include "channel/normals.hpp"

#include "channel/normals_kernel.hpp"

namespace channel {

std::vector<float> draw_normals(const StreamSeeds& seeds, std::size_t n,
                                [[maybe_unused]] InstructionSet set) {
  constexpr std::size_t step = normals_block;
  std::vector<float> normals((n + step - 1) / step * step);
  const NormalsKernelInput input{seeds.data(), normals.data(), normals.size()};
#ifdef COSYS_HAVE_X86
  if (runs_v3(set)) {
    fill_lanes_v3(input);
    return normals;
  }
#endif
  fill_lanes_baseline(input);
  return normals;
}

}  // namespace channel
