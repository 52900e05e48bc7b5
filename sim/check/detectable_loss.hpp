#pragma once
// What a check of a baseline can see at a point: how much a decoder must lose there to be found,
// how surely one that loses as much as the baseline's passes, and how many frames a rise wants.
#include <cstdint>

#include "sim/check/sequential_test.hpp"

namespace sim {

/// What a baseline's decoder lost of the frames of a point, one of `points` that a check has.
struct PointLosses {
  std::uint64_t lost = 0, frames = 0;
  std::uint64_t points = 1;

  double flr() const;
};

/// The least frame loss ratio of a decoder that a check calls worse with that probability, within
/// 1 % of it; NaN where even one that loses all would not be.
double detectable_loss(const SequentialTestRule& rule, const PointLosses& baseline,
                       double probability);

/// How probable it is that one passes that loses as much as the baseline's, for reasons of its own:
/// one that fails on the same light passes more surely.
double passes_if_equal(const SequentialTestRule& rule, const PointLosses& baseline);

/// How many frames it takes that a decoder which loses `rule.worse_than` times as much is called
/// worse, and an equal one passes, each with that probability. 0 where no number does: where so
/// much is negligible, or more than all, or more than 1e9 frames are wanted.
std::uint64_t frames_to_detect(const SequentialTestRule& rule, const PointLosses& baseline,
                               double probability);

}  // namespace sim
