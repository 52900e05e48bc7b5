#include "sim/check/sequential_test.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sim/check/detectable_loss.hpp"

namespace sim {
namespace {

TEST(McNemar, IsTheUpperTailOfFairCoins) {
  const auto p = [](std::uint64_t candidate, std::uint64_t baseline) {
    return mcnemar_p_value({.candidate_only = candidate, .baseline_only = baseline});
  };
  EXPECT_DOUBLE_EQ(p(10, 0), std::pow(2, -10));
  EXPECT_DOUBLE_EQ(p(6, 1), 8.0 / 128);
  EXPECT_DOUBLE_EQ(p(1, 6), 127.0 / 128);
  EXPECT_EQ(p(0, 0), 1);
  EXPECT_EQ(p(0, 9), 1);
}

TEST(McNemar, CriticalCountIsTheFewestThatAreSignificant) {
  for (std::uint64_t n = 0; n < 300; ++n)
    for (const double alpha : {0.05, 1e-3, 1e-5}) {
      const std::uint64_t critical = mcnemar_critical(n, alpha);
      const auto p = [&](std::uint64_t k) {
        return mcnemar_p_value({.candidate_only = k, .baseline_only = n - k});
      };
      if (critical <= n) {
        EXPECT_LE(p(critical), alpha) << n;
      }
      if (critical > 0) {
        EXPECT_GT(p(critical - 1), alpha) << n;
      }
    }
}

TEST(NoWorse, IsTheLowerTailOfCoinsThatManyTimesAsBad) {
  const auto p = [](std::uint64_t candidate, std::uint64_t baseline) {
    return no_worse_p_value({.candidate_only = candidate, .baseline_only = baseline}, 2);
  };
  EXPECT_DOUBLE_EQ(p(0, 3), 1.0 / 27);
  EXPECT_DOUBLE_EQ(p(1, 2), 7.0 / 27);
  EXPECT_EQ(p(3, 0), 1);
  EXPECT_EQ(p(0, 0), 1);
  for (std::uint64_t n = 0; n < 100; ++n) {
    const std::uint64_t critical = no_worse_critical(n, 2, 0.005);
    if (critical > 0) {
      EXPECT_LE(p(critical - 1, n - critical + 1), 0.005);
    }
    EXPECT_GT(critical > n ? 1 : p(critical, n - critical), 0.005);
  }
}

TEST(SequentialTestLooks, DoubleToTheLastAndShareOutAllOfAlpha) {
  for (const std::uint64_t frames : {1U, 63U, 64U, 1000U, 1000000U}) {
    const auto looks = sequential_test_looks(frames);
    EXPECT_EQ(looks.back().frames, frames);
    double sum = 0;
    for (std::size_t i = 0; i < looks.size(); ++i) {
      sum += looks[i].share;
      if (i > 0) {
        EXPECT_EQ(looks[i].frames / 2, looks[i - 1].frames);
      }
    }
    EXPECT_DOUBLE_EQ(sum, 1);
  }
}

TEST(SequentialTest, KeepsTheLeastPOfItsLooks) {
  SequentialTest gate({}, 256, 1000);
  gate.look({.frames = 64, .both = 0, .candidate_only = 12, .baseline_only = 0});
  const double p = gate.p_value();
  EXPECT_EQ(p, std::ldexp(1, -12) / 0.25);
  gate.look({.frames = 128, .both = 0, .candidate_only = 12, .baseline_only = 12});
  EXPECT_EQ(gate.p_value(), p);
}

// That the loss is negligible is asked once, or it would be found by chance at one of many looks.
TEST(SequentialTest, FindsALossNegligibleAtTheLastLookAlone) {
  const SequentialTestRule rule{.negligible = 0.01};
  constexpr std::uint64_t frames = 2048;
  SequentialTest gate(rule, frames, 1);
  ASSERT_LT(frames_to_be_negligible(rule), frames / 2);
  while (const std::uint64_t next = gate.next_look()) {
    EXPECT_EQ(gate.state(), SequentialTestState::undecided) << next;
    gate.look({.frames = next});
  }
  EXPECT_EQ(gate.state(), SequentialTestState::passed);
}

/// Two decoders, of which each loses a frame when it is hard for it: the same frames are hard for
/// both in a share of cases.
struct Decoders {
  double baseline_flr, candidate_flr;
  double alike;
};

using Random = std::mt19937_64;

double uniform_share(Random& random) { return static_cast<double>(random() >> 11U) * 0x1p-53; }

void receive(PairedLosses& losses, const Decoders& decoders, Random& random) {
  const double hardness = uniform_share(random);
  const double others = uniform_share(random) < decoders.alike ? hardness : uniform_share(random);
  losses.add(hardness < decoders.candidate_flr, others < decoders.baseline_flr);
}

SequentialTestState check(const SequentialTestRule& rule, const Decoders& decoders,
                          std::uint64_t frames, Random& random, std::uint64_t points = 1) {
  SequentialTest gate(rule, frames, points);
  PairedLosses losses;
  while (gate.state() == SequentialTestState::undecided && gate.next_look() > 0) {
    while (losses.frames < gate.next_look()) receive(losses, decoders, random);
    gate.look(losses);
  }
  return gate.state();
}

/// How many of so many checks end like that.
int count(SequentialTestState state, const SequentialTestRule& rule, const Decoders& decoders,
          std::uint64_t frames, int checks) {
  Random random(17);
  int n = 0;
  for (int i = 0; i < checks; ++i) n += check(rule, decoders, frames, random) == state;
  return n;
}

constexpr SequentialTestRule twice{.worse_than = 2, .alpha = 1e-3, .power = 0.99};
constexpr double flr = 0.2;

TEST(SequentialTestPower, ADecoderPassesAgainstItselfAThousandTimesOutOfAThousand) {
  const std::uint64_t frames = frames_needed(twice, flr, 1, twice.power);
  EXPECT_EQ(count(SequentialTestState::passed, twice, {flr, flr, 1}, frames, 1000), 1000);
}

TEST(SequentialTestPower, EqualDecodersAreCalledWorseInLessThanOneCheckInAThousand) {
  const std::uint64_t frames = frames_needed(twice, flr, 1, twice.power);
  constexpr int checks = 20000;
  for (const double alike : {0.0, 0.5, 0.9})
    EXPECT_LE(count(SequentialTestState::worse, twice, {flr, flr, alike}, frames, checks),
              checks / 1000)
        << alike;
}

TEST(SequentialTestPower, EqualDecodersPassAsOftenAsWorseOnesAreFound) {
  const std::uint64_t frames = frames_needed(twice, flr, 1, twice.power);
  constexpr int checks = 5000;
  for (const double alike : {0.0, 0.5, 0.9})
    EXPECT_GE(count(SequentialTestState::passed, twice, {flr, flr, alike}, frames, checks),
              0.99 * checks)
        << alike;
}

TEST(SequentialTestPower, ADecoderTwiceAsBadIsFoundInNinetyNineOfAHundredChecks) {
  const std::uint64_t frames = frames_needed(twice, flr, 1, twice.power);
  constexpr int checks = 5000;
  for (const double alike : {0.0, 0.5, 1.0})
    EXPECT_GE(count(SequentialTestState::worse, twice, {flr, 2 * flr, alike}, frames, checks),
              0.99 * checks)
        << alike;
}

// However few frames there are, and however they fail together.
TEST(SequentialTestPower, WhatIsThatMuchWorsePassesInLessThanOneCheckInAHundred) {
  constexpr int checks = 10000;
  for (const std::uint64_t frames : {64U, 200U, 1000U})
    for (const double alike : {0.0, 0.5, 1.0})
      EXPECT_LE(count(SequentialTestState::passed, twice, {flr, 2 * flr, alike}, frames, checks),
                checks / 100)
          << frames << ' ' << alike;
}

TEST(SequentialTestPower, PowerIsWhatChecksShow) {
  constexpr SequentialTestRule rule{.worse_than = 1.5, .alpha = 0.01, .power = 0.99};
  constexpr std::uint64_t frames = 500;
  constexpr int checks = 20000;
  const double power = power_of(rule, flr, frames, 1);
  int found = 0;
  Random random(5);
  for (int i = 0; i < checks; ++i) {
    PairedLosses losses;
    while (losses.frames < frames) receive(losses, {flr, 1.5 * flr, 0}, random);
    found += mcnemar_p_value(losses) <= rule.alpha * sequential_test_looks(frames).back().share;
  }
  EXPECT_GT(power, 0.3);
  EXPECT_LT(power, 0.95);
  // The number of discordant frames is taken as Poisson's, which spreads a little more.
  EXPECT_NEAR(found / double{checks}, power, 0.02);
}

TEST(SequentialTestPower, FalseAlarmsOfManyPointsTogetherKeepToAlpha) {
  constexpr SequentialTestRule rule{.worse_than = 2, .alpha = 0.02, .power = 0.99};
  constexpr int checks = 3000, points = 10;
  Random random(23);
  int alarms = 0;
  for (int i = 0; i < checks; ++i) {
    bool any = false;
    for (int p = 0; p < points; ++p)
      any |= check(rule, {flr, flr, 0.5}, 500, random, points) == SequentialTestState::worse;
    alarms += any;
  }
  EXPECT_LE(alarms, rule.alpha * checks);
  EXPECT_GT(alarms, 0);
}

TEST(SequentialTestPower, WhatIsNegligiblePassesAndWhatIsNotDoesNot) {
  constexpr SequentialTestRule rule{
      .worse_than = 2, .alpha = 1e-3, .power = 0.99, .negligible = 0.01};
  const std::uint64_t frames = frames_to_be_negligible(rule);
  EXPECT_TRUE(is_negligible(0, frames, rule));
  EXPECT_FALSE(is_negligible(0, frames - 1, rule));
  EXPECT_FALSE(is_negligible(1, frames, rule));
  constexpr int checks = 5000;
  EXPECT_EQ(count(SequentialTestState::passed, rule, {0, 0, 0}, frames, 100), 100);
  EXPECT_EQ(count(SequentialTestState::passed, twice, {0, 0, 0}, frames, 100), 0);
  EXPECT_GE(count(SequentialTestState::passed, rule, {0.003, 0.003, 0}, 4000, checks),
            0.99 * checks);
  EXPECT_LE(count(SequentialTestState::passed, rule, {0.004, 0.0101, 0}, 1000, checks),
            checks / 100);
}

// The sum over a million discordant frames has as many terms as that over a thousand: what is asked
// for is met by so many frames, and by 2 % fewer not.
TEST(FramesNeeded, AreThoseThatDoWhereTheyAreMany) {
  const SequentialTestRule close{.worse_than = 1.01, .alpha = 1e-3, .power = 0.999};
  const std::uint64_t frames = frames_needed(close, 0.3, 2, close.power);
  EXPECT_GT(frames, 100'000U);
  EXPECT_GE(power_of(close, 0.3, frames, 2), 0.999);
  EXPECT_GE(pass_probability(close, 0.3, frames), 0.999);
  const std::uint64_t fewer = frames * 98 / 100;
  EXPECT_LT(std::min(power_of(close, 0.3, fewer, 2), pass_probability(close, 0.3, fewer)), 0.999);
}

TEST(FramesNeeded, GrowWithWhatIsAskedFor) {
  const auto needed = [](double worse_than, double alpha, double power, std::uint64_t points = 1) {
    return frames_needed({.worse_than = worse_than, .alpha = alpha, .power = power}, 0.05, points,
                         power);
  };
  EXPECT_GT(needed(1.5, 1e-3, 0.99), needed(2, 1e-3, 0.99));
  EXPECT_GT(needed(2, 1e-6, 0.99), needed(2, 1e-3, 0.99));
  EXPECT_GT(needed(2, 1e-3, 0.999), needed(2, 1e-3, 0.99));
  EXPECT_GT(needed(2, 1e-3, 0.99, 1000), needed(2, 1e-3, 0.99));
  const std::uint64_t frames = needed(2, 1e-3, 0.99);
  EXPECT_GE(power_of({.worse_than = 2}, 0.05, frames, 1), 0.99);
  EXPECT_GE(pass_probability({.worse_than = 2}, 0.05, frames), 0.99);
  EXPECT_LT(pass_probability({.worse_than = 2}, 0.05, frames * 9 / 10), 0.99);
}

// 12 frames that the candidate alone loses are enough (2^-12 < 0.001 / 2 tests / 2 looks' shares),
// and Poisson's number is that in 95 of 100 at a mean of 18.2.
TEST(DetectableLoss, OfADecoderThatLosesNothingIsThatOfTwelveFrames) {
  const double found = detectable_loss(rule_of_checks, {.lost = 0, .frames = 1024}, 0.95);
  EXPECT_NEAR(found, 18.2 / 1024, 0.02 * found);
}

TEST(DetectableLoss, IsCalledWorseAsOftenAsSaid) {
  constexpr std::uint64_t frames = 2000;
  constexpr int checks = 5000;
  const PointLosses losses{.lost = 400, .frames = frames};
  const double found = detectable_loss(rule_of_checks, losses, 0.95);
  const auto worse = [&](double candidate_flr) {
    return count(SequentialTestState::worse, rule_of_checks, {losses.flr(), candidate_flr, 0},
                 frames, checks);
  };
  EXPECT_GE(worse(found), 0.95 * checks);
  EXPECT_LT(worse(losses.flr() + 0.8 * (found - losses.flr())), 0.95 * checks);
}

TEST(DetectableLoss, IsNoneWhereNothingCanBeFound) {
  EXPECT_TRUE(std::isnan(detectable_loss(rule_of_checks, {.lost = 0, .frames = 8}, 0.95)));
  EXPECT_TRUE(std::isnan(detectable_loss(rule_of_checks, {.lost = 100, .frames = 100}, 0.95)));
  EXPECT_TRUE(std::isnan(detectable_loss(rule_of_checks, {}, 0.95)));
}

TEST(PassesIfEqual, AsOftenAsSaidOrMore) {
  constexpr int checks = 3000;
  for (const std::uint64_t frames : {256U, 1024U, 2048U}) {
    const PointLosses losses{.lost = frames / 5, .frames = frames};
    const double passes = passes_if_equal(rule_of_checks, losses);
    const Decoders equal{losses.flr(), losses.flr(), 0};
    const int passed = count(SequentialTestState::passed, rule_of_checks, equal, frames, checks);
    EXPECT_GE(passed, (passes - 0.02) * checks) << frames;
  }
}

TEST(PassesIfEqual, WhereTheLossIsNegligible) {
  EXPECT_EQ(passes_if_equal(rule_of_checks, {.lost = 0, .frames = 1024}), 1);
  EXPECT_EQ(passes_if_equal(rule_of_checks, {.lost = 0, .frames = 100}), 0);
}

TEST(FramesToDetect, AreEnoughAndNoneWhereNoNumberIs) {
  const PointLosses losses{.lost = 50, .frames = 500};
  const std::uint64_t frames = frames_to_detect(rule_of_checks, losses, 0.95);
  const PointLosses many{.lost = frames / 10, .frames = frames};
  EXPECT_LE(detectable_loss(rule_of_checks, many, 0.95), 1.02 * 1.5 * 0.1);
  EXPECT_GE(passes_if_equal(rule_of_checks, many), 0.95);
  EXPECT_EQ(frames_to_detect(rule_of_checks, {.lost = 0, .frames = 500}, 0.95), 0U);
  EXPECT_EQ(frames_to_detect(rule_of_checks, {.lost = 400, .frames = 500}, 0.95), 0U);
  EXPECT_EQ(frames_to_detect(rule_of_checks, {}, 0.95), 0U);
}

}  // namespace
}  // namespace sim
