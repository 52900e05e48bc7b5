#pragma once
// Windows of a trial, for importance sampling: where its noise is prescribed, and where it is asked
// how far its light is above the comparator's level. Plain data, since kernels read them.
#include <cstdint>

namespace channel {

/// The standard normals that the noise of the samples from `first` on is made of, in place of the
/// trial's own.
struct NoiseWindow {
  std::int64_t first = 0, n = 0;
  const float* normals = nullptr;
};

/// Where the chain writes, for each sample from `first` on, the largest output of the band-pass in
/// it less the comparator's level, mW/m2.
struct MarginWindow {
  std::int64_t first = 0, n = 0;
  float* margins = nullptr;
};

}  // namespace channel
