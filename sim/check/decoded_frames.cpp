#include "sim/check/decoded_frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

namespace sim {
namespace {

DecodedFrames frames_of(const Decoded& decoded, const DelimitedStream& line,
                        const std::string& message) {
  DecodedFrames result{.frames = {}, .fault = decoded.fault};
  const std::size_t n = line.frames.size();
  const auto outcomes = decoded.fault
                            ? std::vector<FrameOutcome>(n, {.unknown = true})
                            : outcomes_between_markers(decoded.accepted, message, line.first, n);
  for (std::size_t i = 0; i < n; ++i) result.frames.push_back({outcomes[i], line.frames[i].light});
  const auto unknown = std::ranges::count_if(outcomes, &FrameOutcome::unknown);
  if (!decoded.fault && unknown > 0)
    result.fault = DecoderFault{
        .kind = DecoderFault::Kind::garbage,
        .what = fmt::format("it lost undisturbed messages, beside {} of {} frames", unknown, n),
        .words = {}};
  return result;
}

using OfDecoders = std::vector<DecodedFrames>;

OfDecoders decode_capture(const JudgedLink& judged, const std::vector<const Decoder*>& decoders,
                          std::uint32_t first, int n, const std::atomic<bool>* stop) {
  const DelimitedStream line = hear_delimited(judged, first, n, stop);
  OfDecoders all;
  for (const Decoder* decoder : decoders)
    all.push_back(is_stopped(stop) ? DecodedFrames{}
                                   : frames_of(decoder->decode(line), line, judged.link.message));
  return all;
}

void append(OfDecoders& all, const OfDecoders& capture) {
  for (std::size_t d = 0; d < all.size(); ++d) {
    all[d].frames.insert(all[d].frames.end(), capture[d].frames.begin(), capture[d].frames.end());
    if (!all[d].fault) all[d].fault = capture[d].fault;
  }
}

}  // namespace

std::vector<DecodedFrames> decode_frames(const JudgedLink& judged,
                                         const std::vector<const Decoder*>& decoders,
                                         std::uint32_t first, std::uint32_t n,
                                         const Workers& workers) {
  assert(first % frames_per_capture == 0);
  const std::uint32_t captures = (n + frames_per_capture - 1) / frames_per_capture;
  const SharedRuns shared{.runs = captures, .most_at_once = 1, .workers = workers};
  ParallelRuns<OfDecoders> parallel(
      shared, [&](std::uint32_t capture, int, const std::atomic<bool>* over) {
        const std::uint32_t done = capture * frames_per_capture;
        return decode_capture(judged, decoders, first + done,
                              static_cast<int>(std::min(frames_per_capture, n - done)), over);
      });
  OfDecoders all(decoders.size());
  for (const OfDecoders& capture : parallel()) append(all, capture);
  return all;
}

}  // namespace sim
