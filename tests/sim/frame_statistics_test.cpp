// Which bits of a point's frames fail, and how late edges are: of made up wires, and of trials that
// were counted.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "made_up_trial.hpp"
#include "sim/columns/estimate_text.hpp"
#include "sim/link/link.hpp"
#include "sim/link_experiment/link_measurement.hpp"
#include "sim/loading/load_scenario.hpp"
#include "sim/page/frame_charts.hpp"
#include "sim/section/picture_sections.hpp"
#include "sim/trial/trial.hpp"

namespace sim {
namespace {

FrameStatistics frames_of(const TracedTrial& trial) {
  FrameStatistics frames{.trials = 1, .character_s = 10 / made_up_baud.value};
  add_delays(frames.delays, trial);
  add_wrong_bits(frames.wrong, trial);
  return frames;
}

double most_at(const ChartCurve& curve) {
  return std::ranges::max(curve.points, {}, &ChartPoint::y).x;
}

TEST(FrameStatistics, MeasuresHowLateEachEdgeIs) {
  const FrameStatistics frames = frames_of(made_up_trial("OK\n", "OK\n"));
  ASSERT_EQ(frames.delays.falling_us.size(), frames.delays.rising_us.size());
  ASSERT_GE(frames.delays.falling_us.size(), 6U);
  for (const auto* delays : {&frames.delays.falling_us, &frames.delays.rising_us})
    for (const double delay : *delays) EXPECT_NEAR(delay, 200, 1e-3);
  const Chart jitter = jitter_chart(frames);
  ASSERT_EQ(jitter.curves.size(), 2U);
  EXPECT_NEAR(most_at(jitter.curves[0]), 200, 1);
  double edges = 0;
  for (const ChartPoint& point : jitter.curves[0].points) edges += point.y;
  EXPECT_EQ(edges, static_cast<double>(frames.delays.falling_us.size()));
}

TEST(FrameStatistics, MeasuresDelaysOfMoreThanHalfABit) {
  TracedTrial trial = made_up_trial("OK\n", "");
  const double late_s = 0.7 / made_up_baud.value;
  send_at(trial.rx, "OK\n", 0.1 + late_s);
  trial.delay = dsp::Seconds(0.6 / made_up_baud.value);
  const FrameStatistics frames = frames_of(trial);
  EXPECT_EQ(frames.delays.missing, 0U);
  ASSERT_FALSE(frames.delays.falling_us.empty());
  for (const double delay : frames.delays.falling_us) EXPECT_NEAR(delay, 1e6 * late_s, 1e-3);
}

TEST(FrameStatistics, HasNoDelayOfAnEdgeThatThePinLacks) {
  TracedTrial trial = made_up_trial("OK\n", "OK\n");
  trial.rx = dsp::LogicTrace();
  trial.rx.observe_until(dsp::Seconds(0.5));
  const FrameStatistics frames = frames_of(std::move(trial));
  EXPECT_TRUE(frames.delays.falling_us.empty());
  EXPECT_EQ(frames.delays.missing, 20U) << "6 of O, 8 of K, 6 of a newline";
  EXPECT_TRUE(jitter_chart(frames).curves[0].points.empty());
}

TEST(FrameStatistics, SaysWhichBitsAreWrongAndHowManyInARow) {
  const FrameStatistics frames = frames_of(made_up_trial("OAK\n", "OFK\n"));
  EXPECT_EQ(frames.wrong.characters, (std::vector<std::string>{"O", "A", "K", "\\n"}));
  EXPECT_EQ(frames.wrong.counts[1], (std::array<int, 10>{0, 1, 1, 1, 0, 0, 0, 0, 0, 0}))
      << "0x41 and 0x46: bits 0 to 2";
  EXPECT_EQ(frames.wrong.counts[0], (std::array<int, 10>{}));
  EXPECT_EQ(frames.wrong.bursts, (std::vector<int>{0, 0, 1}));
  const HeatMap map = wrong_bits_map(frames);
  EXPECT_EQ(map.rows, (std::vector<std::string>{"4: \\n", "3: K", "2: A", "1: O"}));
  EXPECT_EQ(map.values[2][1], 1);
  const PageSection bursts = bursts_section(frames);
  ASSERT_TRUE(bursts.picture && bursts.picture->live);
  const ChartCurve& curve = bursts.picture->live->curves.at(0);
  EXPECT_EQ(most_at(curve), 3);
  EXPECT_EQ(curve.points.front().x, 1) << "there is none of 0";
  EXPECT_EQ(curve.points.back().x, 3) << "nor of 4";
  EXPECT_TRUE(frames_of(made_up_trial("OK\n", "OK\n")).wrong.bursts.empty());
}

TEST(FrameStatistics, SayInWordsThatNoWrongBitFollowedAnother) {
  const PageSection bursts = bursts_section(frames_of(made_up_trial("OK\n", "OJ\n")));
  EXPECT_FALSE(bursts.picture) << "of one bar";
  EXPECT_EQ(bursts.text, "In the first 1 trials no wrong bit followed another.");
}

TEST(FrameStatistics, SaysWhenInAMessageBitsAreWrong) {
  const Chart chart = settling_chart(frames_of(made_up_trial("OAK\n", "OFK\n")));
  ASSERT_EQ(chart.curves.at(0).points.size(), 4U);
  EXPECT_NEAR(chart.curves[0].points[1].x, 25, 1e-9) << "ms: the middle of the second of 600 Bd";
  EXPECT_NEAR(chart.curves[0].points[1].y, 0.3, 1e-9) << "three of ten";
  EXPECT_EQ(chart.curves[0].points[2].y, 0);
}

TEST(FrameStatistics, SayHowSurelyBitsAreWrong) {
  FrameStatistics frames{.trials = 0, .character_s = 10 / made_up_baud.value};
  for (const char* read : {"OFK\n", "OAK\n", "OAK\n", "OFK\n", "OAK\n", "OAK\n"}) {
    add_wrong_bits(frames.wrong, made_up_trial("OAK\n", read));
    ++frames.trials;
  }
  const Chart chart = settling_chart(frames);
  EXPECT_EQ(chart.curves[0].kind, CurveKind::bars) << "no slope from one character to the next";
  const ChartPoint& never = chart.curves[0].points[0];
  EXPECT_NEAR(never.high, 1 - std::pow(0.025, 1 / 6.0), 1e-9) << "none of six, as Clopper-Pearson";
  EXPECT_EQ(never.low, 0);
  const ChartPoint& twice = chart.curves[0].points[1];
  const Interval of_bits = clopper_pearson(6, 60, 0.95);
  EXPECT_NEAR(twice.y, 0.1, 1e-12);
  EXPECT_LT(twice.low, of_bits.low) << "they fail three at a time";
  EXPECT_GT(twice.high, of_bits.high);
  EXPECT_EQ(chart_section(chart).table->rows.at(1).at(1),
            estimate_text({0.1, twice.low, twice.high}));
}

// ---- of trials ----

LoadedScenario failing_link(const std::string& more) {
  return parse_scenario(
      "[receiver]\nmodule = \"TSSP4056\"\nrange_m = 12.4\n[simulation]\nwarmup_messages = 0\n"
      "sample_rate_hz = 250000\n" +
          more + "[stop]\nmax_frames = 44\nmax_frame_errors = 0\n",
      "x.toml", {}, {COSYS_SOURCE_DIR "/scenarios"});
}

int wrong_bits(const FrameStatistics& frames) {
  int sum = 0;
  for (const auto& counts : frames.wrong.counts)
    sum = std::accumulate(counts.begin(), counts.end(), sum);
  return sum;
}

int bits_in_bursts(const FrameStatistics& frames) {
  int sum = 0;
  for (std::size_t n = 0; n < frames.wrong.bursts.size(); ++n)
    sum += static_cast<int>(n + 1) * frames.wrong.bursts[n];
  return sum;
}

TEST(FrameStatistics, AreOfTheBitsThatWereCounted) {
  for (const char* fidelity : {"", "fidelity = \"envelope\"\n"}) {
    const LoadedScenario scenario = failing_link(fidelity);
    const Tally tally = run_link(scenario, {}).points.at(0).tally;
    ASSERT_GT(tally.n_bit_errors, 0U);
    ASSERT_EQ(tally.n_frames, 44U);
    const FrameStatistics frames =
        look_at_frames(scenario.base, {0, tally.n_frames}, {.threads = 2});
    EXPECT_EQ(frames.trials, 44);
    EXPECT_TRUE(frames.are_all);
    EXPECT_EQ(static_cast<std::uint64_t>(wrong_bits(frames)), tally.n_bit_errors);
    EXPECT_EQ(bits_in_bursts(frames), wrong_bits(frames));
    EXPECT_TRUE(frames.first_misread);
    EXPECT_NEAR(frames.character_s, 10 / 600.0, 1e-4);
  }
}

// They decide at a bit's end: their pin's edges are not late, but where they are.
TEST(FrameStatistics, HaveNoDelaysOfMatchedReceivers) {
  const LoadedScenario scenario = parse_scenario(
      "[receiver]\nmodule = \"ideal-coherent\"\nrange_m = 1\n[simulation]\nwarmup_messages = 0\n",
      "x.toml", {}, {COSYS_SOURCE_DIR "/scenarios"});
  const FrameStatistics frames = look_at_frames(scenario.base, {0, 2}, {});
  EXPECT_EQ(frames.trials, 2);
  EXPECT_TRUE(frames.delays.falling_us.empty());
  EXPECT_EQ(frames.delays.missing, 0U);
}

TEST(FrameStatistics, AreOfAShardsOwnTrials) {
  const LoadedScenario scenario = failing_link("");
  const auto bits = [&](std::uint64_t first, std::uint64_t last) {
    return wrong_bits(look_at_frames(scenario.base, {first, last}, {.threads = 2}));
  };
  EXPECT_EQ(bits(0, 24) + bits(24, 44), bits(0, 44));
  EXPECT_NE(bits(24, 44), bits(0, 20));
  EXPECT_GE(look_at_frames(scenario.base, {24, 44}, {}).first_misread.value(), 24U);
}

TEST(FrameStatistics, AHistogramHasAnEnd) {
  FrameStatistics frames{.trials = 1};
  frames.delays.falling_us.assign(1000, 200.0);
  frames.delays.falling_us.push_back(80e3);
  const Chart chart = jitter_chart(frames);
  EXPECT_LT(chart.curves.at(0).points.size(), 90U);
  double edges = 0;
  for (const ChartPoint& point : chart.curves[0].points) edges += point.y;
  EXPECT_EQ(edges, 1001) << "none is lost";
}

TEST(FrameStatistics, SayHowMuchLongerPulsesAreAtThePin) {
  FrameStatistics frames{.trials = 1};
  for (int i = -50; i <= 50; ++i) {
    frames.delays.falling_us.push_back(170 + 0.2 * i);
    frames.delays.rising_us.push_back(204 + i);
  }
  frames.delays.falling_us.push_back(-700);
  EXPECT_EQ(
      delays_text(frames),
      "Median delay: 170 us where light begins and 204 us where it ends, so pulses of light are "
      "34 us longer at the pin (pulse-width distortion). Jitter: 7 and 34 us (half of the middle "
      "68 %).");
  frames.delays.missing = 7;
  EXPECT_TRUE(
      delays_text(frames).ends_with(" Of 210 edges of the light 7 are missing at the pin, "
                                    "or more than half a bit from where they belong."));
}

TEST(FrameStatistics, DoNotDependOnThreads) {
  const LoadedScenario scenario = failing_link("");
  const FrameStatistics one = look_at_frames(scenario.base, {0, 30}, {.threads = 1}),
                        three = look_at_frames(scenario.base, {0, 30}, {.threads = 3});
  EXPECT_EQ(one.wrong.counts, three.wrong.counts);
  EXPECT_EQ(one.delays.falling_us, three.delays.falling_us);
  EXPECT_EQ(one.first_misread, three.first_misread);
}

TEST(FrameStatistics, LookAtNoMoreThanWillDo) {
  const LoadedScenario scenario = failing_link("");
  const FrameStatistics first = look_at_frames(scenario.base, {0, 100'000}, {.threads = 2});
  EXPECT_EQ(first.trials, 400);
  EXPECT_FALSE(first.are_all);
  EXPECT_NE(jitter_chart(first).description.find("the first 400 trials"), std::string::npos);
  EXPECT_EQ(look_at_frames(scenario.base, {8, 8}, {}).trials, 0);
}

TEST(FrameStatistics, AffordFewerLongTrials) {
  const Link link = make_link(failing_link("").base);
  const double samples = mean_length(link).value * link.chain.sample_rate.value;
  EXPECT_EQ(affordable_trials(link, 30.5 * samples), 30);
  EXPECT_EQ(affordable_trials(link, samples), 20) << "at least";
}

}  // namespace
}  // namespace sim
