// Built once for each instruction set, as channel/chain_kernel.cpp is.
#include "channel/normals_kernel.hpp"

#include "dsp/normal.hpp"

namespace channel {

void COSYS_NORMALS_KERNEL(const NormalsKernelInput& input) {
  using dsp::Lanes8;
  constexpr int vectors = normals_block / dsp::lanes<Lanes8>;
  dsp::NormalSource<Lanes8> source;
  for (int i = 0; i < dsp::lanes<Lanes8>; ++i) source.seed(i, input.seeds[i]);
  Lanes8 block[vectors];
  for (std::size_t done = 0; done < input.n; done += normals_block) {
    source.fill(block, vectors);
    __builtin_memcpy(input.normals + done, block, sizeof(block));
  }
}

}  // namespace channel
