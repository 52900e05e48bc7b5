// One frame explained, and the least that breaks a decoder.
#include "sim/check/frame_trace.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "scenarios.hpp"
#include "scripted_decoder.hpp"
#include "sim/check/decoded_frames.hpp"
#include "sim/check/frame_picture.hpp"
#include "sim/check/minimise.hpp"

namespace sim {
namespace {

JudgedPoint weak_point() {
  return judged_points(loaded("[receiver]\nmodule = 'TSSP4056'\nrange_m = 12.4\n[simulation]\n"
                              "fidelity = 'envelope'\nwarmup_messages = 1\n"))
      .front();
}

struct Rivals {
  std::unique_ptr<Decoder> atmega = make_built_in_decoder("atmega"),
                           edges = make_built_in_decoder("edge-timing");
};

/// Trials of the first 200 that only edge-timing loses.
std::vector<std::uint32_t> lost_by_edges_alone(const Rivals& rivals) {
  const auto decoded =
      decode_frames(judged_link(weak_point()), {rivals.edges.get(), rivals.atmega.get()}, 0, 200,
                    {.threads = 2, .interrupt = nullptr});
  std::vector<std::uint32_t> trials;
  for (std::uint32_t i = 0; i < 200; ++i)
    if (decoded[0].frames[i].outcome.lost() && decoded[1].frames[i].outcome.delivered)
      trials.push_back(i);
  return trials;
}

TEST(FrameTrace, IsOfTheFrameThatWasJudged) {
  const Rivals rivals;
  const auto trials = lost_by_edges_alone(rivals);
  ASSERT_GT(trials.size(), 10U);
  for (const std::uint32_t trial : trials) {
    const OneFrame frame = hear_frame(weak_point(), trial);
    EXPECT_EQ(frame.trial(), trial);
    EXPECT_TRUE(outcome_of(*rivals.edges, frame).lost()) << trial;
    EXPECT_TRUE(outcome_of(*rivals.atmega, frame).delivered) << trial;
  }
  const std::string story = frame_trace(hear_frame(weak_point(), trials.front()),
                                        {rivals.atmega.get(), rivals.edges.get()});
  EXPECT_NE(story.find("\natmega: delivered\n    \"IND 011111 OK\": ok\n"), std::string::npos)
      << story;
  EXPECT_NE(story.find("\nedge-timing: lost\n"), std::string::npos) << story;
}

TEST(FrameTrace, SaysWhatWasSentSeenAndRead) {
  const JudgedPoint clear = judged_points(loaded("device.message = 'A B'", clear_link())).front();
  const auto mid_bit = make_built_in_decoder("mid-bit");
  const std::string story = frame_trace(hear_frame(clear, 3), {mid_bit.get()});
  EXPECT_EQ(story.find("trial 3: \"A B\" at 82.98 mW/m2, bits of 1666.7 us"), 0U) << story;
  for (const char* part :
       {"'A'     0100000101  0100000101", "' '     0000001001  0000001001",
        "'\\x0a'  0010100001  0010100001", "mid-bit: delivered\n    \"A B\": ok\n"})
    EXPECT_NE(story.find(part), std::string::npos) << part << " in\n" << story;
}

TEST(FrameTrace, SaysWhatADecoderAcceptedThatSaysNoCharacters) {
  const ScriptedDecoder decoder([](std::uint32_t trial) {
    return trial == 3 ? std::vector<std::string>{"A C", "D\x01"} : std::vector<std::string>{"A B"};
  });
  const JudgedPoint clear = judged_points(loaded("device.message = 'A B'", clear_link())).front();
  const auto end_of = [&](std::uint32_t trial) {
    const std::string story = frame_trace(hear_frame(clear, trial), {&decoder});
    return story.substr(story.find("scripted:"));
  };
  EXPECT_EQ(end_of(3),
            "scripted: undetected error\n    accepted \"A C\"\n    accepted \"D\\x01\"\n");
  EXPECT_EQ(end_of(4), "scripted: delivered\n    accepted \"A B\"\n");
}

TEST(FrameTrace, ReadsByABuiltInDecoderWhereNoneSaysCharacters) {
  const ScriptedDecoder decoder([](std::uint32_t) { return std::vector<std::string>{"A B"}; });
  const JudgedPoint clear = judged_points(loaded("device.message = 'A B'", clear_link())).front();
  const std::string story = frame_trace(hear_frame(clear, 3), {&decoder});
  EXPECT_NE(story.find("mid-bit (built in)\n"), std::string::npos) << story;
  EXPECT_NE(story.find("'A'     0100000101  0100000101"), std::string::npos) << story;
  EXPECT_EQ(story.find("mid-bit: "), std::string::npos) << "it is not judged";
}

TEST(FramePicture, ShowsLightAndPinWithTheirBits) {
  const JudgedPoint clear = judged_points(loaded("device.message = 'A B'", clear_link())).front();
  EXPECT_EQ(frame_picture(hear_frame(clear, 3)),
            "the pin has each bit as it was sent, sampled in its middle\n"
            "             'A'                 ' '                 'B'\n"
            "  light      ██  ██████████  ██  ████████████  ████  ████  ████████  ██\n"
            "  pin        ▁▁▔▔▁▁▁▁▁▁▁▁▁▁▔▔▁▁▔▔▁▁▁▁▁▁▁▁▁▁▁▁▔▔▁▁▁▁▔▔▁▁▁▁▔▔▁▁▁▁▁▁▁▁▔▔▁▁▔▔\n"
            "  sent       0 1 0 0 0 0 0 1 0 1 0 0 0 0 0 0 1 0 0 1 0 0 1 0 0 0 0 1 0 1\n"
            "  at the pin 0 1 0 0 0 0 0 1 0 1 0 0 0 0 0 0 1 0 0 1 0 0 1 0 0 0 0 1 0 1\n"
            "\n");
}

TEST(FramePicture, IsAboutTheFirstBitThatDiffers) {
  const JudgedPoint clear =
      judged_points(loaded("device.message = 'ABCDEF'", clear_link())).front();
  OneFrame frame = hear_frame(clear, 0);
  const FrameOnLine& place = frame.frame();
  const dsp::Seconds from = place.byte_start[4] + place.bit * 2, to = from + place.bit;
  dsp::LogicTrace wire(frame.line.wire.initial());
  for (const dsp::Seconds edge : frame.line.wire.edges())
    if (edge < from) wire.add_edge(edge);
  wire.set_at(from, true);  // 'E' is 0100000101: this bit is light
  wire.set_at(to, false);
  for (const dsp::Seconds edge : frame.line.wire.edges())
    if (edge > to) wire.add_edge(edge);
  wire.observe_until(frame.line.wire.end());
  frame.line.wire = wire;
  const std::string picture = frame_picture(frame);
  EXPECT_NE(picture.find("at character 4 'E', data bit 1\n"), std::string::npos) << picture;
  EXPECT_NE(picture.find("'D'                 'E'                 'F'\n"), std::string::npos)
      << picture;
  const std::size_t mark = picture.find('^'), line = picture.rfind('\n', mark) + 1;
  EXPECT_EQ(mark - line, 13 + 20 + 2 * 2U) << picture;
}

TEST(Minimise, FindsTheLeastThatOnlyTheCandidateLosesBy) {
  const Rivals rivals;
  const auto trials = lost_by_edges_alone(rivals);
  ASSERT_GT(trials.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    const OneFrame frame = hear_frame(weak_point(), trials[i]);
    const auto least = minimise(frame, *rivals.edges, *rivals.atmega);
    ASSERT_TRUE(least.has_value());
    EXPECT_TRUE(outcome_of(*rivals.edges, least->frame).lost());
    EXPECT_TRUE(outcome_of(*rivals.atmega, least->frame).delivered);
    EXPECT_GE(least->disturbed.size(), 1U);
    EXPECT_LT(least->disturbed.size(), least->at_first / 4);
    // Other frames of the line are as they were.
    const FrameOnLine& next = frame.line.frames[frame.index + 1];
    for (double t = next.from.value; t < next.to.value; t += 1e-4)
      ASSERT_EQ(least->frame.line.wire.level_at(dsp::Seconds(t)),
                frame.line.wire.level_at(dsp::Seconds(t)));
  }
}

/// Takes each line for a message, whatever its checksum.
class ChecksumIgnored : public Decoder {
 public:
  const std::string& name() const override { return name_; }
  Decoded decode(const DelimitedStream& line) const override {
    Decoded decoded;
    std::string text;
    for (const protocol::UartByte& byte : mid_bit_->characters(line)) {
      text += static_cast<char>(byte.value);
      if (byte.value != '\n') continue;
      if (text.size() > 4) decoded.accepted.push_back(text.substr(0, text.size() - 4));
      text.clear();
    }
    return decoded;
  }

 private:
  std::string name_ = "checksum ignored";
  std::unique_ptr<Decoder> mid_bit_ = make_built_in_decoder("mid-bit");
};

TEST(Minimise, FindsTheLeastThatOnlyTheCandidateAcceptsWrongly) {
  const ChecksumIgnored candidate;
  const auto good = make_built_in_decoder("mid-bit");
  std::uint32_t trial = 0;
  while (trial < 100 && !outcome_of(candidate, hear_frame(weak_point(), trial)).undetected_error)
    ++trial;
  ASSERT_LT(trial, 100U);
  const auto least = minimise(hear_frame(weak_point(), trial), candidate, *good);
  ASSERT_TRUE(least.has_value());
  EXPECT_TRUE(least->accepts_wrongly);
  EXPECT_EQ(least->disturbed.size(), 1U);
  EXPECT_TRUE(outcome_of(candidate, least->frame).undetected_error);
  EXPECT_NE(disturbed_text(*least, candidate, *good)
                .find("checksum ignored accepts what was not sent, mid-bit does not\n"),
            std::string::npos);
}

TEST(Minimise, CannotLeaveOutOneMore) {
  const Rivals rivals;
  const OneFrame frame = hear_frame(weak_point(), lost_by_edges_alone(rivals).front());
  const auto least = minimise(frame, *rivals.edges, *rivals.atmega);
  ASSERT_TRUE(least.has_value());
  // What is left is found again whole from itself.
  const auto again = minimise(least->frame, *rivals.edges, *rivals.atmega);
  ASSERT_TRUE(again.has_value());
  EXPECT_LE(again->at_first, least->disturbed.size());
  EXPECT_EQ(again->disturbed.size(), least->disturbed.size());
}

/// Delivers every frame but one, and that if `hears` its wire.
class OfOneFrame : public Decoder {
 public:
  using Hears = std::function<bool(const dsp::LogicTrace&)>;
  OfOneFrame(std::uint32_t trial, Hears hears) : trial_(trial), hears_(std::move(hears)) {}

  const std::string& name() const override { return name_; }
  Decoded decode(const DelimitedStream& line) const override {
    const bool heard = hears_(line.wire);
    return ScriptedDecoder(heard ? losing(0, 0) : losing(trial_, trial_ + 1)).decode(line);
  }

 private:
  std::string name_ = "of one frame";
  std::uint32_t trial_;
  Hears hears_;
};

// A candidate that loses the frame where all of some late edges are there, and a baseline that
// delivers it where one other is: these edges, and nothing else, are what is left.
TEST(Minimise, LeavesJustWhatItTakes) {
  const OneFrame frame = hear_frame(weak_point(), lost_by_edges_alone(Rivals()).front());
  const OfOneFrame deaf(frame.trial(), [](const dsp::LogicTrace&) { return false; });
  const OfOneFrame good(frame.trial(), [](const dsp::LogicTrace&) { return true; });
  const auto pieces = minimise(frame, deaf, good)->pieces;
  const auto is_late = [&](const dsp::LogicTrace& wire, std::size_t piece) {
    return wire.level_at(pieces[piece].from) != pieces[piece].sent;
  };
  std::vector<std::size_t> late;
  for (std::size_t i = 0; i < pieces.size(); ++i)
    if (is_late(frame.line.wire, i)) late.push_back(i);
  ASSERT_GT(late.size(), 30U);
  for (const std::size_t wanted : {1U, 2U, 3U, 5U, 8U}) {
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < wanted; ++i) chosen.push_back(late[i * i % 29 + i / 6]);
    std::ranges::sort(chosen);
    const OfOneFrame candidate(frame.trial(), [&](const dsp::LogicTrace& wire) {
      return !std::ranges::all_of(chosen, [&](std::size_t i) { return is_late(wire, i); });
    });
    EXPECT_EQ(minimise(frame, candidate, good)->disturbed, chosen);
    const OfOneFrame baseline(
        frame.trial(), [&](const dsp::LogicTrace& wire) { return is_late(wire, late.back()); });
    const auto least = minimise(frame, candidate, baseline);
    chosen.push_back(late.back());
    EXPECT_EQ(least->disturbed, chosen);
  }
}

TEST(Minimise, GivesNothingWhereThereIsNothingToTell) {
  const Rivals rivals;
  const auto trials = lost_by_edges_alone(rivals);
  const OneFrame frame = hear_frame(weak_point(), trials.front());
  EXPECT_FALSE(minimise(frame, *rivals.atmega, *rivals.edges).has_value());
  EXPECT_FALSE(minimise(frame, *rivals.edges, *rivals.edges).has_value());
}

}  // namespace
}  // namespace sim
