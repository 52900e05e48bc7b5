// What limits a link, found by running it again without one thing at a time.
#include "sim/page/ablations.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <string>

#include "sim/link_experiment/link_measurement.hpp"
#include "sim/loading/load_scenario.hpp"

namespace sim {
namespace {

TEST(Ablations, FindTheGainControlOfTheQuickstart) {
  const LoadedScenario scenario = load_scenario(
      COSYS_SOURCE_DIR "/scenarios/quickstart.toml",
      {"stop.max_frames=8", "receiver.range_m=2,2.3,3", "simulation.sample_rate_hz=250000"},
      {COSYS_SOURCE_DIR "/scenarios"});
  const std::atomic<bool> never = false;
  const LinkResult result = run_link(scenario, {.threads = 2});
  const Ablations found = ablate(scenario, result, {2, &never});
  EXPECT_EQ(found.place, "receiver.range_m = 2.3 m");
  std::vector<std::string> names;
  for (const Ablation& o : found.ablations) names.push_back(o.change);
  EXPECT_EQ(names, (std::vector<std::string>{
                       "", "without noise", "without the module's automatic gain control",
                       "with half of the module's threshold", "without ambient light"}));
  std::vector<std::string> limits;
  for (const Ablation& o : limits_of(found)) limits.push_back(o.change);
  EXPECT_EQ(limits, (std::vector<std::string>{"without the module's automatic gain control",
                                              "without ambient light",
                                              "with half of the module's threshold"}))
      << "what carries farthest comes first";
  ASSERT_TRUE(found.along);
  EXPECT_EQ(found.along->key, "receiver.range_m");
  EXPECT_NEAR(found.ablations[0].half->at, 2.18, 0.06) << "quickstart loses none at 2.15 m";
  EXPECT_GT(found.ablations[2].half->at, 10) << "without gain control";
}

/// The quickstart in the dark, without noise and gain control, with one unit.
LoadedScenario quickstart_with(int unit) {
  return load_scenario(
      COSYS_SOURCE_DIR "/scenarios/quickstart.toml",
      {"stop.max_frames=4", "receiver.range_m=10,60", "simulation.sample_rate_hz=250000",
       "noise.scale=0", "module.agc_attack_db_per_ms=0", "ambient.irradiance_w_per_m2=0",
       fmt::format("receiver.unit={}", unit)},
      {COSYS_SOURCE_DIR "/scenarios"});
}

/// One that is less sensitive than most.
LoadedScenario quickstart_with_a_dull_unit() {
  for (int unit = 1;; ++unit) {
    LoadedScenario scenario = quickstart_with(unit);
    if (scenario.base.module.emin_mw_per_m2 > 0.22) return scenario;
  }
}

// Its threshold would be drawn again, of a spread that begins lower, and be as high as before.
TEST(Ablations, HalveTheThresholdOfAUnitAsItIs) {
  const LoadedScenario scenario = quickstart_with_a_dull_unit();
  const std::atomic<bool> never = false;
  const Ablations found = ablate(scenario, run_link(scenario, {.threads = 2}), {2, &never});
  const auto half =
      std::ranges::find(found.ablations, "with half of the module's threshold", &Ablation::change);
  ASSERT_NE(half, found.ablations.end());
  EXPECT_GT(half->half->at, 1.2 * found.ablations.front().half->at);
}

TEST(Ablations, LookForHalfTheLossOnlyWhereItsDirectionIsKnown) {
  const std::atomic<bool> never = false;
  const auto along_of = [&](const std::vector<std::string>& changes) {
    const LoadedScenario scenario = load_scenario(COSYS_SOURCE_DIR "/scenarios/quickstart.toml",
                                                  changes, {COSYS_SOURCE_DIR "/scenarios"});
    return ablate(scenario, run_link(scenario, {.threads = 2}), {2, &never}).along;
  };
  const std::string few = "stop.max_frames=8", fast = "simulation.fidelity=envelope",
                    far = "receiver.range_m=20";
  EXPECT_TRUE(along_of({few, fast, "receiver.range_m=20,21"})) << "all are lost";
  EXPECT_FALSE(along_of({few, fast, far, "led.current_ma=1,2"})) << "all are lost";
  EXPECT_TRUE(along_of({few, fast, "receiver.range_m=2.3", "led.current_ma=20,400"}));
  EXPECT_FALSE(along_of({few, fast, far, "simulation.warmup_messages=1,2"})) << "whole numbers";
}

TEST(Ablations, FindNoHalfAlongTheKeyThatIsLeftOut) {
  const LoadedScenario scenario = parse_scenario(
      "receiver.range_m = 1\nstop.max_frames = 8\nsimulation.warmup_messages = 1\n"
      "simulation.sample_rate_hz = 250000\n"
      "[disturbance.lamp]\nkind = \"fluorescent\"\nballast_hz = 45000\n"
      "[sweep]\ndisturbance.lamp.irradiance_w_per_m2 = [1e-5, 0.05]\n",
      "x.toml", {}, {COSYS_SOURCE_DIR "/scenarios"});
  const std::atomic<bool> never = false;
  const Ablations found = ablate(scenario, run_link(scenario, {.threads = 2}), {2, &never});
  ASSERT_TRUE(found.along);
  EXPECT_EQ(found.along->key, "disturbance.lamp.irradiance_w_per_m2");
  EXPECT_EQ(found.ablations.back().change, "without the disturbance lamp (fluorescent)");
  EXPECT_FALSE(found.ablations.back().half);
  EXPECT_TRUE(found.ablations.front().half);
}

TEST(Ablations, NameADisturbanceAsTheScenarioDoes) {
  const LoadedScenario scenario = parse_scenario(
      "receiver.range_m = 40\nstop.max_frames = 4\nsimulation.sample_rate_hz = 250000\n"
      "[disturbance.lamp]\nkind = \"fluorescent\"\n",
      "x.toml", {}, {COSYS_SOURCE_DIR "/scenarios"});
  const std::atomic<bool> never = false;
  const Ablations found = ablate(scenario, run_link(scenario, {.threads = 2}), {2, &never});
  ASSERT_FALSE(found.ablations.empty());
  EXPECT_EQ(found.ablations.back().change, "without the disturbance lamp (fluorescent)");
}

TEST(Ablations, AreTriedWithFewerLongFrames) {
  const LoadedScenario scenario = parse_scenario(
      "stop.max_frames = 4\ndevice.baud = 10\n"
      "simulation.warmup_messages = 0\nsimulation.fidelity = \"envelope\"\n",
      "x.toml", {"receiver.range_m=40,41"}, {COSYS_SOURCE_DIR "/scenarios"});
  const std::atomic<bool> never = false;
  const Ablations found = ablate(scenario, run_link(scenario, {.threads = 2}), {2, &never});
  ASSERT_FALSE(found.ablations.empty());
  EXPECT_EQ(found.ablations.front().tally.n_frames, 20) << "of ten million samples each";
  EXPECT_FALSE(found.along) << "they would take minutes";
  for (const Ablation& o : found.ablations)
    EXPECT_NE(o.change, "with half of the module's threshold") << "an envelope has no such one";
}

}  // namespace
}  // namespace sim
