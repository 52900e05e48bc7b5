#include "sim/result/crossing_text.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

using Kind = sim::Crossing::Kind;

constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(CrossingSentence, SaysEachOutcome) {
  const sim::Axis axis{"receiver.range_m", "m", "distance", {1, 10}};
  const auto say = [&](sim::Crossing c) { return sim::crossing_sentence(axis, c); };
  EXPECT_EQ(say({Kind::fitted, 7.88, 7.6, 8.2}),
            "frame loss crosses 1 % at receiver.range_m = 7.88 [7.60, 8.20] m");
  EXPECT_EQ(say({Kind::fitted, 78.8, 65, 91}),
            "frame loss crosses 1 % at receiver.range_m = 79 [65, 91] m");
  EXPECT_EQ(say({Kind::fitted, 12.2149, 12.2086, 12.2204}),
            "frame loss crosses 1 % at receiver.range_m = 12.2149 [12.2086, 12.2204] m");
  EXPECT_EQ(say({Kind::fitted, 12.21, 12.1349, 12.2851}),
            "frame loss crosses 1 % at receiver.range_m = 12.210 [12.134, 12.286] m")
      << "rounded outwards";
  EXPECT_EQ(say({Kind::jump, 7.5, 7, 8, 0.003, 7}),
            "frame loss crosses 1 % between receiver.range_m = 7 .. 8 m, two neighbours in the "
            "sweep");
  EXPECT_EQ(say({Kind::jump, 7.5, 7, 8, 0.018, 7}),
            "frame loss crosses 1 % between receiver.range_m = 7 .. 8 m, two neighbours in the "
            "sweep, though 1.8 % cannot be ruled out at 7 m");
  EXPECT_EQ(say({Kind::bracketed, 7.5, 7, 8}),
            "frame loss crosses 1 % between receiver.range_m = 7 .. 8 m");
  EXPECT_EQ(say({Kind::bracketed, 7.5, -infinity, 8}),
            "frame loss crosses 1 % below receiver.range_m = 8 m: too few frames to tell how far "
            "below");
  EXPECT_EQ(say({Kind::bracketed, 7.5, 7, infinity}),
            "frame loss crosses 1 % above receiver.range_m = 7 m: too few frames to tell how far "
            "above");
  EXPECT_EQ(say({Kind::all_below, 3, 1, 5}),
            "frame loss stays at most 1 % over receiver.range_m = 1 .. 5 m");
  EXPECT_EQ(say({Kind::all_below, 3, 1, 5, 0.0377}),
            "frame loss is seen to stay at most 1 % over receiver.range_m = 1 .. 5 m, though "
            "3.8 % cannot be ruled out");
  EXPECT_EQ(say({Kind::all_above, 1, 1, 1, 0.02}),
            "frame loss is above 1 % over receiver.range_m = 1 m");
  EXPECT_EQ(say({Kind::unclear}),
            "frame loss does not clearly cross 1 % inside the sweep of receiver.range_m");
  EXPECT_EQ(
      say({Kind::unfinished, 2, 1, 3}),
      "where frame loss crosses 1 % along receiver.range_m is not told yet: counted at 1 .. 3 "
      "m alone");
  EXPECT_EQ(say({Kind::unfinished, std::nan(""), std::nan(""), std::nan("")}),
            "where frame loss crosses 1 % along receiver.range_m is not counted yet");
  EXPECT_EQ(say({Kind::not_monotone}),
            "frame loss rises and falls along receiver.range_m: no single crossing of 1 %");
}

TEST(ReachSentence, SaysEachOutcome) {
  const sim::Axis axis{"receiver.range_m", "m", "distance", {1, 10}};
  const auto say = [&](sim::Crossing c) { return sim::reach_sentence(axis, c); };
  EXPECT_EQ(say({Kind::fitted, 7.88, 7.6, 8.2}),
            "the link reaches 7.88 [7.60, 8.20] m at 1 % frame loss");
  EXPECT_EQ(say({Kind::jump, 7.5, 7, 8, 0.018, 7}),
            "the link reaches 7 to 8 m at 1 % frame loss, two neighbours in the sweep, though 1.8 "
            "% cannot be ruled out at 7 m");
  EXPECT_EQ(say({Kind::bracketed, 7.5, 7, 8}), "the link reaches 7 to 8 m at 1 % frame loss");
  EXPECT_EQ(say({Kind::bracketed, 7.5, -infinity, 8}),
            "the link reaches less than 8 m at 1 % frame loss: too few frames to tell how far "
            "below");
  EXPECT_EQ(say({Kind::all_below, 3, 1, 5, 0.0377}),
            "the link reaches more than 5 m: at most 1 % of frames lost at 1 .. 5 m, though 3.8 % "
            "cannot be ruled out");
  EXPECT_EQ(say({Kind::all_above, 1, 1, 5, 0.02}),
            "the link reaches less than 1 m: more than 1 % of frames lost at 1 .. 5 m");
  for (const Kind kind : {Kind::unclear, Kind::unfinished, Kind::not_monotone})
    EXPECT_EQ(say({kind, 2, 1, 3}), sim::crossing_sentence(axis, {kind, 2, 1, 3}));
}

TEST(CrossingWords, SayEachOutcomeInAList) {
  const sim::Axis axis{"receiver.range_m", "m", "distance", {1, 10}};
  const auto say = [&](sim::Crossing c) { return sim::crossing_words(axis, c, false); };
  EXPECT_EQ(say({Kind::fitted, 7.88, 7.6, 8.2}), "7.88 [7.60, 8.20] m");
  EXPECT_EQ(say({Kind::jump, 7.5, 7, 8, 0.018, 7}), "7 to 8 m");
  EXPECT_EQ(say({Kind::bracketed, 7.5, 7, 8}), "7 to 8 m");
  EXPECT_EQ(say({Kind::bracketed, 7.5, -infinity, 8}), "less than 8 m");
  EXPECT_EQ(say({Kind::bracketed, 7.5, 7, infinity}), "more than 7 m");
  EXPECT_EQ(say({Kind::all_below, 3, 1, 5}), "more than 5 m");
  EXPECT_EQ(say({Kind::all_above, 3, 1, 5, 0.02}), "less than 1 m");
  EXPECT_EQ(sim::crossing_words(axis, {Kind::all_above, 3, 1, 5, 0.02}, true), "more than 5 m");
  EXPECT_EQ(say({Kind::unfinished, 2, 1, 3}), "not told yet: counted at 1 .. 3 m alone");
  EXPECT_EQ(say({Kind::unfinished, std::nan(""), std::nan(""), std::nan("")}), "not counted yet");
  EXPECT_EQ(say({Kind::not_monotone}), "no single value, as loss rises and falls");
  EXPECT_EQ(say({}), "not told by so few frames");
}

TEST(CrossingNote, SaysWhatTheFramesDoNotTell) {
  const auto say = [&](sim::Crossing c) { return sim::crossing_note(c); };
  EXPECT_EQ(say({Kind::jump, 7.5, 7, 8, 0.003, 7}), "");
  EXPECT_EQ(say({Kind::jump, 7.5, 7, 8, 0.018, 7}), "1.8 % possible");
  EXPECT_EQ(say({Kind::all_below, 3, 1, 5, 0.0377}), "3.8 % possible");
  EXPECT_EQ(say({Kind::all_above, 3, 1, 5, 0.02}), "");
  EXPECT_EQ(say({Kind::all_above, 3, 1, 5, 0.0013}), "0.13 % possible");
  EXPECT_EQ(say({Kind::bracketed, 7.5, 7, 8}), "");
  EXPECT_EQ(say({Kind::bracketed, 7.5, -infinity, 8}), "too few frames");
  EXPECT_EQ(say({Kind::fitted, 7.88, 7.6, 8.2}), "");
}

// Units between the least and the greatest of three quantiles.
TEST(SpanWords, SayWhereMostUnitsEnd) {
  const sim::Axis axis{"receiver.range_m", "m", "distance", {10, 0.5, 3}};
  const auto say = [&](sim::UnitRange least, sim::UnitRange most) {
    return sim::span_words(axis, {least, {0.5, 3}, most});
  };
  const sim::UnitRange below{-infinity, 0.5}, beyond{10, infinity};
  EXPECT_EQ(say({0.5, 3}, {3, 10}), "0.5 to 10 m");
  EXPECT_EQ(say({3, 10}, {0.5, 3}), "0.5 to 10 m") << "where more is better";
  EXPECT_EQ(say({0.5, 3}, beyond), "0.5 m to beyond 10 m");
  EXPECT_EQ(say(below, {3, 10}), "below 0.5 m to 10 m");
  EXPECT_EQ(say(below, beyond), "below 0.5 m to beyond 10 m");
  EXPECT_EQ(say(below, below), "below 0.5 m");
  EXPECT_EQ(say(beyond, beyond), "beyond 10 m");
}

}  // namespace
