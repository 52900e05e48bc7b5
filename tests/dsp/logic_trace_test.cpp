#include "dsp/logic_trace.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace dsp {
namespace {

Seconds s(double t) { return Seconds(t); }

// A wire that changes at random whole seconds; whole, so that questions also hit the very instants.
std::vector<int> random_edges(std::mt19937& random) {
  std::vector<int> at;
  int t = 0;
  for (int i = std::uniform_int_distribution(0, 20)(random); i > 0; --i) {
    at.push_back(t += std::uniform_int_distribution(1, 6)(random));
  }
  return at;
}

LogicTrace trace_of(bool initial, const std::vector<int>& edges) {
  LogicTrace trace(initial);
  for (int t : edges) trace.add_edge(s(t));
  return trace;
}

bool plain_level(bool initial, const std::vector<int>& edges, double t) {
  const auto passed = std::count_if(edges.begin(), edges.end(), [t](int f) { return f <= t; });
  return initial != (passed % 2 != 0);
}

// The first edge at or after t that leaves the wire at 0.
std::optional<Seconds> plain_fall(bool initial, const std::vector<int>& edges, double t) {
  for (int f : edges) {
    if (f >= t && !plain_level(initial, edges, f)) return s(f);
  }
  return std::nullopt;
}

TEST(LogicTrace, LevelIsTheParityOfTheEdgesPassed) {
  std::mt19937 random(1);
  for (int round = 0; round < 200; ++round) {
    const bool initial = round % 2 == 0;
    const std::vector<int> edges = random_edges(random);
    const LogicTrace trace = trace_of(initial, edges);
    for (double t = -1; t < 130; t += 0.5) {
      ASSERT_EQ(trace.level_at(s(t)), plain_level(initial, edges, t));
    }
    EXPECT_EQ(trace.final_level(), trace.level_at(s(1e9)));
    EXPECT_EQ(trace.initial(), initial);
  }
}

TEST(LogicTrace, ReaderAgreesWithTheTrace) {
  std::mt19937 random(2);
  for (int round = 0; round < 200; ++round) {
    const bool initial = round % 2 == 0;
    const std::vector<int> edges = random_edges(random);
    const LogicTrace trace = trace_of(initial, edges);
    TraceReader levels(trace), falls(trace), both(trace);
    for (double t = -1; t < 130; t += std::uniform_int_distribution(0, 4)(random) / 2.0) {
      ASSERT_EQ(levels.level_at(s(t)), plain_level(initial, edges, t));
      ASSERT_EQ(falls.next_fall(s(t)), plain_fall(initial, edges, t));
      ASSERT_EQ(both.next_fall(s(t)), plain_fall(initial, edges, t));
      ASSERT_EQ(both.level_at(s(t)), plain_level(initial, edges, t));
    }
  }
}

TEST(LogicTrace, SettingLevelsIsTheSameAsAddingEdges) {
  std::mt19937 random(3);
  LogicTrace trace(true), edged(true);
  bool level = true;
  for (int t = 0; t < 200; ++t) {
    const bool next = std::bernoulli_distribution()(random);
    trace.set_at(s(t), next);
    if (next != level) edged.add_edge(s(t));
    level = next;
    EXPECT_EQ(trace.final_level(), next);
  }
  EXPECT_EQ(trace, edged);
}

TEST(LogicTrace, AnEdgeCountsFromItsInstant) {
  const LogicTrace trace = trace_of(true, {2, 3});
  EXPECT_TRUE(trace.level_at(s(1.999)));
  EXPECT_FALSE(trace.level_at(s(2)));
  EXPECT_FALSE(trace.level_at(s(2.999)));
  EXPECT_TRUE(trace.level_at(s(3)));
}

TEST(LogicTrace, TwoEdgesAtOneInstantCancel) {
  EXPECT_TRUE(trace_of(false, {4, 4}).edges().empty());
  const LogicTrace trace = trace_of(true, {1, 4, 4, 6});
  EXPECT_EQ(trace, trace_of(true, {1, 6}));
  TraceReader reader(trace);
  EXPECT_EQ(reader.next_fall(s(2)), std::nullopt);
}

TEST(LogicTrace, IsIdleHighAndUnobservedAtFirst) {
  const LogicTrace trace;
  EXPECT_TRUE(trace.initial());
  EXPECT_TRUE(trace.final_level());
  EXPECT_TRUE(trace.edges().empty());
  EXPECT_EQ(trace.end(), s(0));
}

TEST(LogicTrace, ObservationCoversTheLastEdgeAndNeverShrinks) {
  LogicTrace trace(true, s(5));
  trace.add_edge(s(3));
  EXPECT_EQ(trace.end(), s(5));
  trace.add_edge(s(7));
  EXPECT_EQ(trace.end(), s(7));
  trace.observe_until(s(9));
  trace.observe_until(s(1));
  EXPECT_EQ(trace.end(), s(9));
}

TEST(LogicTrace, EqualMeansSameStartEdgesAndEnd) {
  EXPECT_EQ(trace_of(true, {1, 2}), trace_of(true, {1, 2}));
  EXPECT_NE(trace_of(true, {1, 2}), trace_of(false, {1, 2}));
  EXPECT_NE(trace_of(true, {1, 2}), trace_of(true, {1, 3}));
  EXPECT_NE(LogicTrace(true, s(1)), LogicTrace(true, s(2)));
}

TEST(LogicTrace, ALowWireHasNoFallBeforeItRises) {
  const LogicTrace trace = trace_of(false, {2, 5});
  TraceReader reader(trace);
  EXPECT_EQ(reader.next_fall(s(0)), s(5));
}

#ifndef NDEBUG
TEST(LogicTraceDeathTest, TimeDoesNotRunBackwards) {
  LogicTrace trace = trace_of(true, {4});
  EXPECT_DEATH(trace.add_edge(s(3)), "edges_");
}
#endif

}  // namespace
}  // namespace dsp
