#pragma once
// One point of a check: what baseline and candidate made of its frames, and what follows from it.
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "sim/check/baseline.hpp"
#include "sim/check/decoded_frames.hpp"
#include "sim/check/sequential_test.hpp"

namespace sim {

enum class Verdict { passed, worse, inconclusive, broken };

/// What a candidate is compared with.
enum class Pairing {
  stored,    // the baseline's outcomes of the same light
  decoded,   // the light is not the baseline's any more: its decoder has decoded the new
  unpaired,  // the same, but that decoder is a program, which only its user may run
};

struct PointCheck {
  JudgedPoint point;
  std::uint64_t limit = 0;  // frames that may be judged
  Pairing pairing = Pairing::stored;
  FrameCounts baseline{}, candidate{};         // of the frames that were judged
  PairedLosses losses{}, undetected_errors{};  // not of unpaired ones
  double p_lost = 1, p_undetected = 1;         // of a candidate that is no worse
  bool no_worse = false;                       // shown by the rule's margin
  std::optional<DecoderFault> fault{};
  std::vector<std::uint32_t> only_candidate_lost{}, only_baseline_lost{},
      only_candidate_undetected{};
  double power = std::numeric_limits<double>::quiet_NaN();  // of finding `worse_than`
  std::uint64_t frames_needed = 0;  // for the rule's power; 0: where nothing or all is lost
  Verdict verdict = Verdict::inconclusive;
};

struct CheckSetup {
  SequentialTestRule rule;
  std::uint64_t frames = 0;  // of each point at most; 0: as many as the baseline has
  const Decoder& candidate;
  const Decoder* baseline;  // null if it cannot be run again
  std::size_t points = 1;   // of the check
  bool golden = false;      // every frame must come out as it did
};

/// All but the verdict, which depends on other points too. After an interrupt nothing is judged.
PointCheck check_point(const CheckSetup& setup, const JudgedPoint& point,
                       const BaselinePoint& baseline, const Workers& workers);

/// Gives each point its verdict, by Holm's correction over losses and undetected errors of all.
void judge(std::vector<PointCheck>& checks, const CheckSetup& setup);

/// Of all points together: the worst.
Verdict verdict_of(const std::vector<PointCheck>& checks);

}  // namespace sim
