#pragma once
// A comparison of decoders on the same light: what each loses, and which of two loses less.
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "sim/check/decoded_frames.hpp"
#include "sim/check/judged_point.hpp"
#include "sim/check/paired_losses.hpp"

namespace sim {

/// Two decoders at a point, by their places in the comparison; `losses` has the first as candidate
/// and the second as baseline.
struct PairComparison {
  std::size_t first, second;
  PairedLosses losses{};
  double p_value = 1;  // that they lose equally often: McNemar's exact test, two-sided
  bool decided = false;

  bool first_wins() const { return losses.candidate_only < losses.baseline_only; }
};

struct DecoderComparisonPoint {
  JudgedPoint point;
  std::vector<FrameCounts> counts;                  // one a decoder
  std::vector<std::optional<DecoderFault>> faults;  // the same
  std::vector<PairComparison> pairs;                // of every two that did not fail
};

/// All decoders on the first `frames` frames of a point. Worth nothing after an interrupt.
DecoderComparisonPoint compare_decoders(const JudgedPoint& point,
                                        const std::vector<const Decoder*>& decoders,
                                        std::uint32_t frames, const Workers& workers);

/// Decides pairs by Holm's correction over those of all points.
void decide(std::vector<DecoderComparisonPoint>& points, double alpha);

struct DecoderComparisonReport {
  const std::vector<DecoderComparisonPoint>& points;
  const std::vector<const Decoder*>& decoders;
  double alpha;
};
std::string decoder_comparison_text(const DecoderComparisonReport& report);
std::string decoder_comparison_json(const DecoderComparisonReport& report);

}  // namespace sim
