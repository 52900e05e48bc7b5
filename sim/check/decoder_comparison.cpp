#include "sim/check/decoder_comparison.hpp"

#include <algorithm>

#include "sim/counting/holm.hpp"

namespace sim {
namespace {

FrameCounts decoder_counts(const DecodedFrames& decoded) {
  FrameCounts counts;
  if (decoded.fault) return counts;
  for (const FrameRecord& frame : decoded.frames) counts.add(frame.outcome);
  return counts;
}

PairComparison pair_comparison_of(const std::vector<DecodedFrames>& decoded, std::size_t first,
                                  std::size_t second) {
  PairComparison pair{.first = first, .second = second};
  for (std::size_t i = 0; i < decoded[first].frames.size(); ++i)
    pair.losses.add(decoded[first].frames[i].outcome.lost(),
                    decoded[second].frames[i].outcome.lost());
  const PairedLosses& l = pair.losses;
  const PairedLosses mirrored{.frames = l.frames,
                              .both = l.both,
                              .candidate_only = l.baseline_only,
                              .baseline_only = l.candidate_only};
  pair.p_value = std::min(1.0, 2 * std::min(mcnemar_p_value(l), mcnemar_p_value(mirrored)));
  return pair;
}

}  // namespace

DecoderComparisonPoint compare_decoders(const JudgedPoint& point,
                                        const std::vector<const Decoder*>& decoders,
                                        std::uint32_t frames, const Workers& workers) {
  const auto decoded = decode_frames(judged_link(point), decoders, 0, frames, workers);
  DecoderComparisonPoint result{.point = point, .counts = {}, .faults = {}, .pairs = {}};
  for (const DecodedFrames& one : decoded) {
    result.counts.push_back(decoder_counts(one));
    result.faults.push_back(one.fault);
  }
  for (std::size_t second = 1; second < decoded.size(); ++second)
    for (std::size_t first = 0; first < second; ++first)
      if (!decoded[first].fault && !decoded[second].fault)
        result.pairs.push_back(pair_comparison_of(decoded, first, second));
  return result;
}

void decide(std::vector<DecoderComparisonPoint>& points, double alpha) {
  std::vector<double> p_values;
  for (const DecoderComparisonPoint& point : points)
    for (const PairComparison& pair : point.pairs) p_values.push_back(pair.p_value);
  const std::vector<bool> differ = rejected_by_holm(p_values, alpha);
  std::size_t next = 0;
  for (DecoderComparisonPoint& point : points)
    for (PairComparison& pair : point.pairs) pair.decided = differ[next++];
}

}  // namespace sim
