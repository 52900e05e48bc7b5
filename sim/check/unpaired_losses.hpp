#pragma once
// What two decoders lost of frames that are not the same, and the exact tests of which loses more:
// those of paired_losses where the light is not shared.
#include <cstdint>

namespace sim {

struct LostOf {
  std::uint64_t lost = 0, frames = 0;
};

/// Fisher's exact test, one-sided: how probable it is that the candidate loses so many of all that
/// were lost, or more, if it loses no more often than the baseline does.
double fisher_p_value(const LostOf& candidate, const LostOf& baseline);

/// The opposite: how probable so few are, or fewer, if it loses at least `worse_than` times as
/// often. Its odds are then that many times as large or more, by which Fisher's noncentral
/// hypergeometric distribution bounds it.
double fisher_no_worse_p_value(const LostOf& candidate, const LostOf& baseline, double worse_than);

}  // namespace sim
