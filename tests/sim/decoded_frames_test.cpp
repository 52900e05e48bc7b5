// Frames as several decoders make them out.
#include "sim/check/decoded_frames.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "scenarios.hpp"

namespace sim {
namespace {

JudgedLink weak_link() {
  return {link_of({"receiver.module=TSSP4056", "receiver.range_m=12.4",
                   "simulation.fidelity=envelope", "simulation.warmup_messages=1"}),
          dsp::Hertz(600)};
}

std::vector<FrameOutcome> outcomes(const DecodedFrames& decoded) {
  std::vector<FrameOutcome> all;
  for (const FrameRecord& frame : decoded.frames) all.push_back(frame.outcome);
  return all;
}

std::vector<DecodedFrames> frames_of(const std::vector<const Decoder*>& decoders,
                                     std::uint32_t first, std::uint32_t n, int threads = 1) {
  return decode_frames(weak_link(), decoders, first, n, {.threads = threads, .interrupt = nullptr});
}

TEST(DecodedFrames, OfOneDecoderDoNotHangOnOthersNorOnThreads) {
  const auto atmega = make_built_in_decoder("atmega"), edges = make_built_in_decoder("edge-timing");
  const auto together = frames_of({edges.get(), atmega.get()}, 0, 300);
  const auto alone = frames_of({atmega.get()}, 0, 300, 3);
  EXPECT_EQ(outcomes(together[1]), outcomes(alone[0]));
  EXPECT_NE(outcomes(together[0]), outcomes(alone[0]));
  EXPECT_EQ(alone[0].frames.size(), 300U);
  const auto lost = std::ranges::count_if(outcomes(alone[0]), &FrameOutcome::lost);
  EXPECT_GT(lost, 30);
  EXPECT_LT(lost, 270);
}

TEST(DecodedFrames, AreTheSameWherePointsAreGoneOnWith) {
  const auto decoder = make_built_in_decoder("software-serial");
  const auto all = outcomes(frames_of({decoder.get()}, 0, 300)[0]);
  const auto rest = outcomes(frames_of({decoder.get()}, 128, 172)[0]);
  EXPECT_EQ(std::vector(all.begin() + 128, all.end()), rest);
}

/// Says nothing of every third capture.
class Forgetful : public Decoder {
 public:
  const std::string& name() const override { return name_; }
  Decoded decode(const DelimitedStream& line) const override {
    if (line.first / frames_per_capture % 3 == 1) return {};
    return decoder_->decode(line);
  }

 private:
  std::string name_ = "forgetful";
  std::unique_ptr<Decoder> decoder_ = make_built_in_decoder("atmega");
};

TEST(DecodedFrames, AreUnknownWhereADecoderLosesUndisturbedMessages) {
  const Forgetful decoder;
  const DecodedFrames decoded = frames_of({&decoder}, 0, 384).front();
  ASSERT_TRUE(decoded.fault.has_value());
  EXPECT_EQ(decoded.fault->kind, DecoderFault::Kind::garbage);
  EXPECT_EQ(decoded.fault->what, "it lost undisturbed messages, beside 128 of 128 frames");
  const auto all = outcomes(decoded);
  EXPECT_EQ(std::ranges::count_if(all, &FrameOutcome::unknown), 128);
  EXPECT_TRUE(all[128].unknown && all[255].unknown);
}

/// Fails after it has said something.
class Failing : public Decoder {
 public:
  const std::string& name() const override { return name_; }
  Decoded decode(const DelimitedStream& line) const override {
    Decoded decoded = decoder_->decode(line);
    decoded.fault = {.kind = DecoderFault::Kind::timeout, .what = "late", .words = "oh"};
    return decoded;
  }

 private:
  std::string name_ = "failing";
  std::unique_ptr<Decoder> decoder_ = make_built_in_decoder("atmega");
};

TEST(DecodedFrames, AreUnknownNotLostWhereADecoderFails) {
  const Failing decoder;
  const DecodedFrames decoded = frames_of({&decoder}, 0, 64).front();
  ASSERT_TRUE(decoded.fault.has_value());
  EXPECT_EQ(decoded.fault->what, "late");
  for (const FrameOutcome& outcome : outcomes(decoded)) {
    EXPECT_TRUE(outcome.unknown);
    EXPECT_FALSE(outcome.lost());
  }
}

}  // namespace
}  // namespace sim
