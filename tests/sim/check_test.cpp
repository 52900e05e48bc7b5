// One point of a check, with decoders that are worse on purpose.
#include <gtest/gtest.h>

#include <functional>

#include "protocol/cosys.hpp"
#include "scenarios.hpp"
#include "scripted_decoder.hpp"
#include "sim/check/point_check.hpp"
#include "sim/check/unpaired_losses.hpp"
#include "sim/failure.hpp"

namespace sim {
namespace {

constexpr dsp::Hertz baud{600};

/// A decoder by what it makes of the wire.
class OwnDecoder : public Decoder {
 public:
  using Bytes = std::function<std::vector<protocol::UartByte>(const dsp::LogicTrace&)>;
  explicit OwnDecoder(Bytes bytes) : bytes_(std::move(bytes)) {}

  const std::string& name() const override { return name_; }
  Decoded decode(const DelimitedStream& line) const override {
    Decoded decoded;
    protocol::CosysDecoder decoder;
    for (const protocol::UartByte& byte : bytes_(line.wire)) {
      const auto frame = decoder.push(byte);
      if (frame && frame->outcome == protocol::CosysOutcome::ok)
        decoded.accepted.push_back(frame->message);
    }
    return decoded;
  }

 private:
  std::string name_ = "own";
  Bytes bytes_;
};

/// One sample a bit, at that part of it.
std::vector<protocol::UartByte> sample_at(const dsp::LogicTrace& line, double part) {
  std::vector<protocol::UartByte> bytes;
  dsp::TraceReader reader(line);
  const dsp::Seconds bit = dsp::period(baud);
  for (auto start = reader.next_fall(dsp::Seconds(0)); start;) {
    protocol::UartByte byte{.start = *start};
    for (int i = 0; i < protocol::data_bits; ++i)
      if (line.level_at(*start + bit * (1 + i + part)))
        byte.value = static_cast<std::uint8_t>(byte.value | (1U << static_cast<unsigned>(i)));
    const dsp::Seconds stop = *start + bit * (protocol::stop_slot + part);
    byte.framing_error = !line.level_at(stop);
    bytes.push_back(byte);
    start = reader.next_fall(stop);
  }
  return bytes;
}

OwnDecoder sampling_at(double part) {
  return OwnDecoder([=](const dsp::LogicTrace& line) { return sample_at(line, part); });
}

/// A weak signal from a device whose clock is slow, or not.
JudgedPoint judged_point(const char* clock_error_ppm, const char* range_m = "12.4") {
  return judged_points(
             loaded("[receiver]\nmodule = 'TSSP4056'\n[simulation]\nfidelity = 'envelope'\n"
                    "warmup_messages = 1\n",
                    {std::string("device.clock_error_ppm=") + clock_error_ppm,
                     std::string("receiver.range_m=") + range_m}))
      .front();
}

constexpr SequentialTestRule rule{
    .worse_than = 1.5, .alpha = 1e-3, .power = 0.99, .negligible = 0.01};

BaselinePoint baseline_of(const JudgedPoint& point, const Decoder& decoder, std::uint32_t frames) {
  return {
      .name = point.name,
      .scenario = 0,
      .physics = physics_hash(point),
      .frames = decode_frames(judged_link(point), {&decoder}, 0, frames, two_threads)[0].frames};
}

PointCheck checked(const CheckSetup& setup, const JudgedPoint& point,
                   const BaselinePoint& baseline) {
  std::vector<PointCheck> checks{check_point(setup, point, baseline, two_threads)};
  judge(checks, setup);
  return checks.front();
}

PointCheck compared(const JudgedPoint& point, const Decoder& candidate, const Decoder& baseline,
                    std::uint32_t frames = 2000) {
  return checked({.rule = rule, .candidate = candidate, .baseline = nullptr}, point,
                 baseline_of(point, baseline, frames));
}

TEST(Check, FindsADecoderThatSamplesTenPercentLate) {
  const OwnDecoder good = sampling_at(0.5), late = sampling_at(0.6);
  const PointCheck check = compared(judged_point("40000"), late, good);
  EXPECT_EQ(check.verdict, Verdict::worse);
  EXPECT_GT(check.candidate.lost, check.baseline.lost);
  EXPECT_LT(check.losses.frames, 2000U) << "it stops early";
  EXPECT_EQ(check.only_candidate_lost.size(), check.losses.candidate_only);
  EXPECT_EQ(compared(judged_point("40000"), good, late).verdict, Verdict::passed);
}

TEST(Check, PassesADecoderThatIsTheSame) {
  const OwnDecoder good = sampling_at(0.5), same = sampling_at(0.5000001);
  for (const char* error : {"0", "40000"}) {
    const PointCheck check = compared(judged_point(error), same, good);
    EXPECT_EQ(check.verdict, Verdict::passed);
    EXPECT_EQ(check.losses.discordant(), 0U);
    EXPECT_EQ(check.pairing, Pairing::stored);
  }
}

TEST(Check, IsInconclusiveRatherThanGuess) {
  const OwnDecoder good = sampling_at(0.5);
  const PointCheck few = compared(judged_point("0", "12.25"), good, good, 200);
  EXPECT_EQ(few.verdict, Verdict::inconclusive);
  EXPECT_LT(few.power, 0.5);
  EXPECT_GT(few.frames_needed, 200U);
}

// Losses and wrong messages are two tests a point: of 64 frames eleven are 0.98 of a thousandth, of
// which each has half.
TEST(Check, StopsEarlyForNothingThatHolmWouldLetPass) {
  const JudgedPoint point = judged_point("0");
  const BaselinePoint good = baseline_of(point, ScriptedDecoder(losing(0, 0)), 128);
  SequentialTestRule nothing_is_negligible = rule;
  nothing_is_negligible.negligible = 0;
  const auto checked_losing = [&](std::uint32_t lost) {
    const ScriptedDecoder candidate(losing(0, lost));
    return checked({.rule = nothing_is_negligible, .candidate = candidate, .baseline = nullptr},
                   point, good);
  };
  const PointCheck eleven = checked_losing(11), twelve = checked_losing(12);
  EXPECT_EQ(eleven.losses.frames, 128U);
  EXPECT_EQ(eleven.verdict, Verdict::inconclusive);
  EXPECT_EQ(twelve.losses.frames, 64U);
  EXPECT_EQ(twelve.verdict, Verdict::worse);
}

TEST(Check, FindsADecoderThatAcceptsWrongMessages) {
  const OwnDecoder good = sampling_at(0.5);
  int n = 0;
  const OwnDecoder liar([&](const dsp::LogicTrace& line) {
    auto bytes = sample_at(line, 0.5);
    std::vector<protocol::UartByte> more;
    for (const auto& byte : bytes) {  // behind each marker's line another message
      more.push_back(byte);
      if (byte.value != '\n' || ++n % 4 != 0) continue;
      for (const char c : std::string("A 41\n"))
        more.push_back({byte.start, static_cast<std::uint8_t>(c), false});
    }
    return more;
  });
  const JudgedPoint point = judged_point("0");
  std::vector<PointCheck> checks{check_point({.rule = rule, .candidate = liar, .baseline = nullptr},
                                             point, baseline_of(point, good, 512),
                                             {.threads = 1, .interrupt = nullptr})};
  judge(checks, {.rule = rule, .candidate = liar, .baseline = nullptr});
  EXPECT_EQ(checks[0].verdict, Verdict::worse);
  EXPECT_EQ(checks[0].losses.discordant(), 0U);
  EXPECT_GT(checks[0].undetected_errors.candidate_only, 10U);
}

TEST(Check, DoesNotPassWhatSeemsToAcceptMoreThanTheBaseline) {
  const ScriptedDecoder decoder(losing(0, 0));
  const CheckSetup setup{.rule = rule, .candidate = decoder, .baseline = nullptr};
  const auto verdict_at = [&](double p_undetected) {
    std::vector<PointCheck> checks{
        {.point = judged_point("0"), .p_undetected = p_undetected, .no_worse = true}};
    judge(checks, setup);
    return checks[0].verdict;
  };
  EXPECT_EQ(verdict_at(0.5), Verdict::passed);
  EXPECT_EQ(verdict_at(2 * (1 - rule.power)), Verdict::passed);
  EXPECT_EQ(verdict_at(0.5 * (1 - rule.power)), Verdict::inconclusive);
  EXPECT_EQ(verdict_at(1e-9), Verdict::worse);
}

// Few losses settle a point at its first look, of 64 frames; wrong messages may come later.
TEST(Check, ListensUntilWrongMessagesAreToldToo) {
  const JudgedPoint point = judged_point("0");
  const BaselinePoint weak = baseline_of(point, ScriptedDecoder(losing(0, 40)), 1024);
  const auto checked_lying_from = [&](std::uint32_t from) {
    const ScriptedDecoder candidate([=](std::uint32_t trial) {
      const bool lies = trial >= from && trial % 8 == 0;
      return lies ? std::vector{sent_message, std::string("A")} : std::vector{sent_message};
    });
    return checked({.rule = rule, .candidate = candidate, .baseline = nullptr}, point, weak);
  };
  const PointCheck liar = checked_lying_from(64), honest = checked_lying_from(1024);
  EXPECT_EQ(liar.verdict, Verdict::worse);
  EXPECT_GT(liar.undetected_errors.candidate_only, 10U);
  EXPECT_EQ(honest.verdict, Verdict::passed);
  EXPECT_EQ(honest.losses.frames, 1024U) << "568 without one are needed, which is between looks";
}

/// As if another version of the program had made it.
BaselinePoint of_other_light(BaselinePoint baseline) {
  baseline.frames[200].light ^= 1;
  return baseline;
}

TEST(Check, DecodesTheNewLightAgainWhereTheBaselinesIsAnother) {
  const auto atmega = make_built_in_decoder("atmega"), late = make_built_in_decoder("edge-timing");
  const JudgedPoint point = judged_point("0");
  const BaselinePoint old = baseline_of(point, *atmega, 1000);
  CheckSetup setup{.rule = rule, .candidate = *late, .baseline = atmega.get()};
  const PointCheck same = checked(setup, point, old);
  const PointCheck other = checked(setup, point, of_other_light(old));
  EXPECT_EQ(same.pairing, Pairing::stored);
  EXPECT_EQ(other.losses.candidate_only, same.losses.candidate_only);
  EXPECT_EQ(other.verdict, same.verdict);
}

TEST(Check, ComparesCountsWhereTheBaselineCannotDecodeTheNewLight) {
  const auto atmega = make_built_in_decoder("atmega");
  const JudgedPoint point = judged_point("0");
  BaselinePoint old = baseline_of(point, *atmega, 1000);
  old.frames[20].light ^= 1;
  const PointCheck same =
      checked({.rule = rule, .candidate = *atmega, .baseline = nullptr}, point, old);
  EXPECT_EQ(same.pairing, Pairing::unpaired);
  EXPECT_EQ(same.candidate.lost, same.baseline.lost);
  EXPECT_EQ(same.candidate.frames, 1000U);
  EXPECT_EQ(same.verdict, Verdict::passed);
  const OwnDecoder late = sampling_at(0.9);
  EXPECT_EQ(checked({.rule = rule, .candidate = late, .baseline = nullptr}, point, old).verdict,
            Verdict::worse);
}

// A third of what may be missed is for this way to pass.
TEST(Check, PassesCountsThatAreSurelyBelowTheMargin) {
  constexpr std::uint32_t frames = 1000, lost = 100;
  const JudgedPoint point = judged_point("0");
  BaselinePoint old = baseline_of(point, ScriptedDecoder(losing(0, lost)), frames);
  old.frames[0].light ^= 1;
  const auto is_sure = [&](std::uint32_t n) {
    return fisher_no_worse_p_value({n, frames}, {lost, frames}, 1.5) <= 0.01 / 3;
  };
  std::uint32_t most = 0;
  while (is_sure(most + 1)) ++most;
  const auto verdict_of_losing = [&](std::uint32_t n) {
    const ScriptedDecoder candidate(losing(0, n));
    return checked({.rule = rule, .candidate = candidate, .baseline = nullptr}, point, old).verdict;
  };
  EXPECT_GT(most, 50U);
  EXPECT_EQ(verdict_of_losing(most), Verdict::passed);
  EXPECT_EQ(verdict_of_losing(most + 1), Verdict::inconclusive);
}

TEST(Check, LeavesOutWhatTheBaselineDoesNotKnowOfTheNewLight) {
  const JudgedPoint point = judged_point("0");
  const ScriptedDecoder good(losing(0, 0)), without_a_marker(losing(0, 0), 5);
  BaselinePoint old = baseline_of(point, good, 128);
  old.frames[0].light ^= 1;
  const PointCheck check =
      checked({.rule = rule, .candidate = good, .baseline = &without_a_marker}, point, old);
  EXPECT_EQ(check.pairing, Pairing::decoded);
  EXPECT_EQ(check.losses.frames, 126U) << "all but the two beside that marker";
  EXPECT_EQ(check.baseline.frames, 126U);
  EXPECT_EQ(check.candidate.frames, 126U);
}

TEST(Check, GoldenCountsWrongMessagesToo) {
  const JudgedPoint point = judged_point("0");
  const ScriptedDecoder good(losing(0, 0)), liar([](std::uint32_t trial) {
    return trial == 7 ? std::vector<std::string>{sent_message, "A"} : std::vector{sent_message};
  });
  const CheckSetup setup{.rule = rule, .candidate = liar, .baseline = nullptr, .golden = true};
  const PointCheck check = checked(setup, point, baseline_of(point, good, 64));
  EXPECT_EQ(check.verdict, Verdict::worse);
  EXPECT_EQ(check.losses.discordant(), 0U);
  EXPECT_EQ(check.only_candidate_undetected, std::vector<std::uint32_t>{7});
}

TEST(Check, GoldenSaysEveryFrameThatComesOutOtherwise) {
  const auto atmega = make_built_in_decoder("atmega");
  const JudgedPoint point = judged_point("0");
  BaselinePoint old = baseline_of(point, *atmega, 300);
  const CheckSetup setup{
      .rule = rule, .candidate = *atmega, .baseline = atmega.get(), .golden = true};
  EXPECT_EQ(checked(setup, point, old).verdict, Verdict::passed);
  old.frames[299].outcome.delivered = !old.frames[299].outcome.delivered;
  const PointCheck flipped = checked(setup, point, old);
  EXPECT_EQ(flipped.verdict, Verdict::worse);
  EXPECT_EQ(flipped.losses.frames, 300U);
  EXPECT_EQ(flipped.only_baseline_lost.size() + flipped.only_candidate_lost.size(), 1U);
}

// The points of a scenario tell its name.
TEST(BaselineFile, IsRefusedWhereAScenarioHasNoPoint) {
  const auto path = std::filesystem::path(testing::TempDir()) / "no_point.h5";
  Baseline baseline{.program = {"cosys-sim", "0", "0"},
                    .command = "",
                    .decoder = "atmega",
                    .scenarios = {"", ""},
                    .points = {{.name = "a", .scenario = 0, .physics = 1, .frames = {{}}},
                               {.name = "b", .scenario = 1, .physics = 1, .frames = {{}}}}};
  write_baseline(path, baseline);
  EXPECT_EQ(read_baseline(path).scenarios.size(), 2U);
  baseline.points.erase(baseline.points.begin());
  write_baseline(path, baseline);
  EXPECT_THROW(read_baseline(path), Failure);
  std::filesystem::remove(path);
}

TEST(Check, SaysThatADecoderFailedAndNotThatItLost) {
  const auto atmega = make_built_in_decoder("atmega");
  const OwnDecoder deaf([](const dsp::LogicTrace&) { return std::vector<protocol::UartByte>(); });
  const PointCheck check = compared(judged_point("0"), deaf, *atmega, 300);
  EXPECT_EQ(check.verdict, Verdict::broken);
  ASSERT_TRUE(check.fault.has_value());
  EXPECT_EQ(check.fault->kind, DecoderFault::Kind::garbage);
}

}  // namespace
}  // namespace sim
