// The decoders soft and soft-alone against the plain ones, on the light of scenarios/decoders.toml.
#include <gtest/gtest.h>

#include <algorithm>

#include "scenarios.hpp"
#include "sim/check/decoded_frames.hpp"
#include "sim/check/judged_point.hpp"
#include "sim/check/paired_losses.hpp"

namespace sim {
namespace {

constexpr std::uint32_t frames_sent = 1024;
constexpr Workers workers{.threads = 2, .interrupt = nullptr};

std::vector<JudgedPoint> points_of_decoders() {
  return judged_points(load_scenario(COSYS_SOURCE_DIR "/scenarios/decoders.toml", {},
                                     {COSYS_SOURCE_DIR "/scenarios"}));
}

/// All built-in decoders' outcomes of the same frames, in their order.
std::vector<DecodedFrames> decoded_by_all(const JudgedPoint& point) {
  std::vector<std::unique_ptr<Decoder>> owned;
  std::vector<const Decoder*> decoders;
  for (const std::string& name : built_in_decoders())
    decoders.push_back(owned.emplace_back(make_built_in_decoder(name)).get());
  return decode_frames(judged_link(point), decoders, 0, frames_sent, workers);
}

std::ptrdiff_t undetected_error(const DecodedFrames& decoded) {
  return std::ranges::count_if(
      decoded.frames, [](const FrameRecord& frame) { return frame.outcome.undetected_error; });
}

PairedLosses paired(const DecodedFrames& candidate, const DecodedFrames& baseline) {
  PairedLosses losses;
  for (std::size_t i = 0; i < frames_sent; ++i)
    losses.add(candidate.frames[i].outcome.lost(), baseline.frames[i].outcome.lost());
  return losses;
}

TEST(SoftDecoders, MeasuredLoseLessThanEachPlainOneWithoutMoreWrongMessages) {
  const auto names = built_in_decoders();
  for (const JudgedPoint& point : points_of_decoders()) {
    const auto all = decoded_by_all(point);
    for (std::size_t soft = names.size() - 2; soft < names.size(); ++soft)
      for (std::size_t plain = 0; plain < names.size() - 2; ++plain) {
        const std::string what = point.name + ": " + names[soft] + ", " + names[plain];
        EXPECT_FALSE(all[soft].fault.has_value()) << what;
        EXPECT_LT(mcnemar_p_value(paired(all[plain], all[soft])), 1e-3) << what;
        EXPECT_LE(undetected_error(all[soft]), undetected_error(all[plain])) << what;
      }
  }
}

}  // namespace
}  // namespace sim
