// Decoders against each other on the same light.
#include "sim/check/decoder_comparison.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "program.hpp"
#include "scenarios.hpp"
#include "scripted_decoder.hpp"

namespace sim {
namespace {

JudgedPoint weak_point(const char* clock_error_ppm) {
  return judged_points(loaded("[receiver]\nmodule = 'TSSP4056'\nrange_m = 12.4\n[simulation]\n"
                              "fidelity = 'envelope'\nwarmup_messages = 1\n",
                              {std::string("device.clock_error_ppm=") + clock_error_ppm}))
      .front();
}

/// Loses each nth frame that atmega delivers.
class Careless : public Decoder {
 public:
  explicit Careless(int n) : n_(n) {}
  const std::string& name() const override { return name_; }
  Decoded decode(const DelimitedStream& line) const override {
    Decoded decoded = decoder_->decode(line);
    int delivered = 0;
    std::erase_if(decoded.accepted, [&](const std::string& message) {
      return !is_like_marker(message) && ++delivered % n_ == 0;
    });
    return decoded;
  }

 private:
  int n_;
  std::string name_ = "careless";
  std::unique_ptr<Decoder> decoder_ = make_built_in_decoder("atmega");
};

TEST(DecoderComparison, SaysWhoLosesLess) {
  const auto atmega = make_built_in_decoder("atmega");
  const Careless careless(4);
  std::vector<DecoderComparisonPoint> points{
      compare_decoders(weak_point("0"), {&careless, atmega.get(), atmega.get()}, 640, two_threads)};
  decide(points, 1e-3);
  const auto& pairs = points[0].pairs;
  ASSERT_EQ(pairs.size(), 3U);
  for (const PairComparison& pair : pairs) {
    const bool of_equals = pair.first == 1;
    EXPECT_EQ(pair.decided, !of_equals) << pair.first << pair.second;
    if (!of_equals) {
      EXPECT_FALSE(pair.first_wins());
      EXPECT_EQ(pair.losses.baseline_only, 0U);
    }
  }
  EXPECT_EQ(points[0].counts[1].frames, 640U);
  EXPECT_EQ(points[0].counts[1].lost, points[0].counts[2].lost);
  EXPECT_GT(points[0].counts[0].lost, points[0].counts[1].lost);
}

// Ten of fifteen coins, or five: 2 (3003 + 1365 + 455 + 105 + 15 + 1) / 2^15.
TEST(DecoderComparison, IsTwoSided) {
  const ScriptedDecoder ten(losing(0, 10)), five(losing(10, 15));
  for (const bool swapped : {false, true}) {
    const auto pairs = compare_decoders(weak_point("0"),
                                        swapped ? std::vector<const Decoder*>{&five, &ten}
                                                : std::vector<const Decoder*>{&ten, &five},
                                        64, two_threads)
                           .pairs;
    ASSERT_EQ(pairs.size(), 1U);
    EXPECT_NEAR(pairs[0].p_value, 2 * 4944.0 / 32768, 1e-12);
    EXPECT_EQ(pairs[0].first_wins(), swapped);
  }
}

TEST(DecoderComparison, LeavesOpenWhatFewFramesDoNotTell) {
  const auto atmega = make_built_in_decoder("atmega");
  const Careless careless(10);
  std::vector<DecoderComparisonPoint> points{
      compare_decoders(weak_point("0"), {&careless, atmega.get()}, 64, two_threads)};
  decide(points, 1e-3);
  EXPECT_FALSE(points[0].pairs[0].decided);
}

TEST(DecoderComparison, DoesNotLetTheSilentTakePart) {
  const auto atmega = make_built_in_decoder("atmega");
  class Silent : public Decoder {
   public:
    const std::string& name() const override { return name_; }
    Decoded decode(const DelimitedStream&) const override { return {}; }

   private:
    std::string name_ = "silent";
  } silent;
  std::vector<DecoderComparisonPoint> points{
      compare_decoders(weak_point("0"), {&silent, atmega.get()}, 64, two_threads)};
  EXPECT_TRUE(points[0].faults[0].has_value());
  EXPECT_TRUE(points[0].pairs.empty());
  EXPECT_EQ(points[0].counts[0].frames, 0U);
  const std::vector<const Decoder*> decoders{&silent, atmega.get()};
  EXPECT_NE(decoder_comparison_text({points, decoders, 1e-3}).find("silent failed at x: "),
            std::string::npos);
}

class CompareCommand : public CommandLine {};

TEST_F(CompareCommand, OfAllBuiltInDecodersSaysThatNoneIsBestEverywhere) {
  write("weak.toml",
        "[receiver]\nmodule = 'TSSP4056'\nrange_m = 12.4\n[simulation]\nfidelity = 'envelope'\n"
        "warmup_messages = 1\n[sweep]\ndevice.clock_error_ppm = [0, 40000]\n");
  const Outcome o = program({"compare", "weak.toml", "-n", "600", "-q"});
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(o.err, "");
  EXPECT_NE(o.out.find("atmega loses less than edge-timing at 2 points, more at 0; at 0 it is "
                       "open\n"),
            std::string::npos)
      << o.out;
  const auto json =
      nlohmann::json::parse(program({"compare", "weak.toml", "-n", "600", "-q", "--json",
                                     "--decoder", "mid-bit", "--decoder", "software-serial"})
                                .out);
  for (const auto& point : json["points"]) {
    EXPECT_EQ(point["decoders"].size(), 2U);
    EXPECT_EQ(point["duels"].size(), 1U);
    EXPECT_EQ(point["decoders"][0]["n_frames"], 600);
  }
}

TEST_F(CompareCommand, FailsWhereADecoderDoes) {
  write("weak.toml", "[simulation]\nwarmup_messages = 0\nsample_rate_hz = 250000\n");
  const Outcome o = program({"compare", "weak.toml", "-n", "16", "-q", "--decoder", "atmega",
                             "--decoder", "echo why >&2; exit 7"});
  EXPECT_EQ(o.code, 1);
  EXPECT_NE(o.out.find("echo why >&2; exit 7 failed at weak: exit code 7 (why)\n"),
            std::string::npos)
      << o.out;
}

}  // namespace
}  // namespace sim
