#pragma once
// What two decoders lost of the same frames, and the exact test whether one loses more.
#include <cstdint>

namespace sim {

struct PairedLosses {
  std::uint64_t frames = 0;
  std::uint64_t both = 0;                               // lost by both decoders
  std::uint64_t candidate_only = 0, baseline_only = 0;  // the discordant frames

  void add(bool candidate_lost, bool baseline_lost);
  std::uint64_t discordant() const { return candidate_only + baseline_only; }
  std::uint64_t lost_by_candidate() const { return both + candidate_only; }
  std::uint64_t lost_by_baseline() const { return both + baseline_only; }
};

/// McNemar's exact test, one-sided: how probable so many frames that the candidate alone loses are,
/// or more, if it loses no more than the baseline does: the upper tail of a binomial of the
/// discordant frames at 1/2. 1 where there are none.
double mcnemar_p_value(const PairedLosses& losses);

/// The fewest of `discordant` frames for which that is at most `alpha`; discordant + 1 if none are.
std::uint64_t mcnemar_critical(std::uint64_t discordant, double alpha);

/// The opposite, exact too: how probable so few frames that the candidate alone loses are, if it
/// loses at least `worse_than` times what the baseline does: of discordant frames it then has
/// worse_than / (1 + worse_than) or more. 1 where there are none.
double no_worse_p_value(const PairedLosses& losses, double worse_than);

/// The most of `discordant` frames for which that is at most `beta`, plus 1; 0 if none are.
std::uint64_t no_worse_critical(std::uint64_t discordant, double worse_than, double beta);

}  // namespace sim
