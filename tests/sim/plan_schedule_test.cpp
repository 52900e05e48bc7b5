// Schedules that measure a module: within their minutes, in order, and at levels that the bench
// can make.
#include "sim/fit/plan_schedule.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "sim/components/parts.hpp"
#include "sim/failure.hpp"
#include "sim/fit/plan_text.hpp"

namespace sim {
namespace {

const PartSources shipped_parts{.folders = {std::filesystem::path(COSYS_SOURCE_DIR) / "scenarios"},
                                .carried = {},
                                .carrier = {}};

channel::ModuleData module_named(const std::string& name) {
  return load_module(name, shipped_parts, name).data;
}
channel::EmitterData bench_led() { return load_led("TSAL6200", shipped_parts, "TSAL6200").data; }

Plan scheduled(const std::string& module, double minutes) {
  return plan_of(schedule_for(module_named(module), bench_led(), minutes));
}

bool is_like(const PlanStep& step, std::uint64_t on, std::uint64_t repeats) {
  return step.cycles_on == on && step.repeats == repeats;
}

TEST(PlanSchedule, FitsItsMinutesAndFillsThem) {
  for (const double minutes : {1.0, 2.5, 5.0, 30.0}) {
    const BenchSchedule schedule = schedule_for(module_named("TSOP4856"), bench_led(), minutes);
    const double seconds = static_cast<double>(clocks_of(schedule)) / bench_clock_hz;
    EXPECT_LE(seconds, 60 * minutes);
    EXPECT_GE(seconds, 60 * minutes - 5) << "no trial takes longer";
    EXPECT_LE(schedule.steps.size(), 1500U) << "what the sketch has room for";
  }
}

// The reader looks for overlaps, too.
TEST(PlanSchedule, IsAPlanThatCanBeReadForAnyModule) {
  for (const PartFile& file : list_parts(shipped_parts.folders)) {
    if (file.kind != "module" || file.name.starts_with("ideal")) continue;
    for (const double minutes : {1, 7}) {
      const Plan plan = scheduled(file.name, minutes);
      EXPECT_EQ(plan_of_text(plan_text(plan, {}), "p.txt"), plan) << file.name;
      EXPECT_EQ(plan.steps.front().level_db, 0);
    }
  }
}

TEST(PlanSchedule, OfAMinuteHasSomeOfEachPart) {
  const Plan plan = scheduled("TSOP4856", 1);
  std::set<double> attack_levels, emin_levels, carriers;
  std::set<std::uint64_t> held;
  int releases = 0;
  for (const PlanStep& step : plan.steps) {
    carriers.insert(step.carrier_hz);
    if (is_like(step, 67200, 1)) attack_levels.insert(step.level_db);
    if (is_like(step, 30, 30) && step.carrier_hz == 16e6 / 286) emin_levels.insert(step.level_db);
    if (is_like(step, 20, 100)) ++releases;
    if (step.level_db > -39 && step.level_db < -37 && step.cycles_on > 50)
      held.insert(step.cycles_on);
  }
  EXPECT_EQ(attack_levels.size(), 8U);
  EXPECT_NEAR(*attack_levels.rbegin() - *attack_levels.begin(), 56, 0.5);
  EXPECT_EQ(emin_levels.size(), 5U);
  EXPECT_EQ(carriers.size(), 5U);
  EXPECT_GE(releases, 5 + 1) << "behind strong carriers, and the release's own";
  EXPECT_GE(held.size(), 5U);
}

// A level once more is wrong by the same error, and tells little.
TEST(PlanSchedule, OfFiveMinutesHasLevelsBetweenThoseOfItsFirstPass) {
  std::map<double, std::set<double>> short_bursts;  // levels by carrier
  std::set<double> carriers;
  std::size_t steps = 0;
  for (const PlanStep& step : scheduled("TSOP4856", 5).steps) {
    if (is_like(step, 67200, 1)) carriers.insert(step.level_db);
    if (!is_like(step, 30, 30)) continue;
    short_bursts[step.carrier_hz].insert(step.level_db);
    ++steps;
  }
  EXPECT_EQ(short_bursts.size(), 5U);
  std::size_t levels = 0;
  for (const auto& [carrier_hz, of_carrier] : short_bursts) {
    EXPECT_EQ(of_carrier.size(), carrier_hz == 16e6 / 286 ? 10U : 8U) << carrier_hz;
    levels += of_carrier.size();
  }
  EXPECT_EQ(levels, steps) << "each of them once";
  EXPECT_GE(carriers.size(), 15U);
}

TEST(PlanSchedule, HasTheBurstsOfTheModule) {
  const Plan plan = scheduled("TSOP4856", 5);
  std::set<std::uint64_t> bursts;
  for (const PlanStep& step : plan.steps) bursts.insert(step.cycles_on);
  for (const std::uint64_t cycles : {20U, 30U, 60U, 98U, 150U, 300U, 600U, 67200U})
    EXPECT_TRUE(bursts.contains(cycles)) << cycles;
}

// Which bursts are short and which gaps end one shows in dense trains of both, on either side of
// what is expected: bursts of 80 cycles, gaps of 29.
TEST(PlanSchedule, OfFiveMinutesHasShortTrainsOfManyGaps) {
  std::set<std::pair<std::uint64_t, std::uint64_t>> trains;
  for (const PlanStep& step : scheduled("TSOP4856", 5).steps)
    if (step.repeats == 300 && step.cycles_off < 60)
      trains.insert({step.cycles_on, step.cycles_off});
  const auto has = [&](std::uint64_t longest_on, std::uint64_t longest_off) {
    return std::ranges::any_of(trains, [&](const auto& train) {
      return train.first <= longest_on && train.second <= longest_off;
    });
  };
  EXPECT_GE(trains.size(), 30U);
  EXPECT_TRUE(has(40, 15));
  EXPECT_TRUE(
      std::ranges::any_of(trains, [](const auto& t) { return t.first > 100 && t.second > 40; }));
}

// It sends 3500 edges a second, and has room for 128.
TEST(PlanSchedule, HasNoMoreEdgesThanTheSketchCanSend) {
  for (const PartFile& file : list_parts(shipped_parts.folders)) {
    if (file.kind != "module" || file.name.starts_with("ideal")) continue;
    for (const PlanStep& step : scheduled(file.name, 7).steps) {
      const auto period_cycles = static_cast<double>(step.cycles_on + step.cycles_off);
      if (step.repeats > 60) {
        EXPECT_LE(2 * step.carrier_hz / period_cycles, 3500) << file.name;
      }
    }
  }
}

// What a short burst charges a little shows in many of them.
TEST(PlanSchedule, OfFiveMinutesHasDenseTrainsOfManyBursts) {
  std::set<double> levels;
  std::size_t trains = 0;
  for (const PlanStep& step : scheduled("TSOP4856", 5).steps) {
    if (step.repeats != 1000) continue;
    ++trains;
    levels.insert(step.level_db);
    EXPECT_LT(step.cycles_on, 80U) << "short ones";
    EXPECT_LT(step.cycles_off, 1.5 * 29 + 1);
  }
  EXPECT_EQ(trains, 12U);
  EXPECT_EQ(levels.size(), 3U);
}

// Dense bursts hold the gain of some parts, so its way back from afar shows in seldom ones alone.
TEST(PlanSchedule, OfFiveMinutesHasSeldomBurstsAloneBehindCarriers) {
  const Plan plan = scheduled("TSOP4856", 5);
  std::set<double> weaker;
  for (std::size_t s = 1; s < plan.steps.size(); ++s) {
    const PlanStep &carrier = plan.steps[s - 1], &bursts = plan.steps[s];
    if (!is_like(carrier, 67200, 1) || bursts.cycles_on != 20) continue;
    const double dark_ms = 1e3 * static_cast<double>(bursts.cycles_off) / bursts.carrier_hz;
    if (dark_ms > 30) weaker.insert(std::round(carrier.level_db - bursts.level_db));
  }
  ASSERT_EQ(weaker.size(), 4U);
  EXPECT_NEAR(*weaker.begin(), 22, 1);
  EXPECT_NEAR(*weaker.rbegin(), 42, 1);
}

TEST(PlanSchedule, RefusesWhatCannotBeMeasured) {
  const auto refusal = [](channel::ModuleData like) -> std::string {
    try {
      schedule_for(like, bench_led(), 1);
    } catch (const Failure& e) {
      return e.what();
    }
    return "taken";
  };
  channel::ModuleData fast = module_named("TSOP4856");
  fast.centre_hz = 455e3;
  EXPECT_EQ(refusal(fast),
            "TSOP4856 has its centre at 455000 Hz (the sketch makes carriers for modules of 17778 "
            "to 58181 Hz) write a plan by hand, for a generator of your own");
  EXPECT_EQ(refusal(module_named("ideal-coherent")),
            "ideal-coherent (no module that can be bought) name one that is like yours");
}

TEST(BenchLevels, ComeNearAndAreToldAsTheyAre) {
  const int period = 286;
  const BenchLevels levels(bench_led(), period);
  EXPECT_EQ(levels.pulse(0, period).level_db, 0);
  for (double wanted = 0; wanted >= -61; wanted -= 0.5) {
    const BenchPulse pulse = levels.pulse(wanted, period);
    EXPECT_NEAR(pulse.level_db, wanted, 0.8);
    EXPECT_GE(period - pulse.width, 190) << "the gate has time";
  }
}

// By hand: of equal current half the sine of the pulse is 6 dB.
TEST(BenchLevels, AreThoseOfTheFundamental) {
  const BenchLevels levels(bench_led(), 300);
  const BenchPulse full = levels.pulse(0, 300), part = levels.pulse(-6, 300);
  EXPECT_EQ(full.pin, part.pin);
  EXPECT_EQ(full.width, 100);
  EXPECT_EQ(part.width,
            std::lround(300 / M_PI * std::asin(std::sin(M_PI / 3) * std::pow(10, -0.3))));
  EXPECT_NEAR(part.level_db,
              20 * std::log10(std::sin(M_PI * part.width / 300) / std::sin(M_PI / 3)), 0.005);
}

TEST(BenchLevels, KeepTheirResistorOnAllCarriers) {
  const BenchLevels levels(bench_led(), 286);
  for (const double wanted : {0, -8, -32, -38, -44, -50})
    for (const int period : {260, 272, 301, 317}) {
      EXPECT_EQ(levels.pulse(wanted, period).pin, levels.pulse(wanted, 286).pin);
      EXPECT_NEAR(levels.pulse(wanted, period).level_db, wanted, 0.8);
    }
}

// 24 mA give 17.3 mW/sr; a third of a cycle has the fundamental of sin(60 degrees) of half a one.
TEST(BenchDistance, PutsTheStrongestLevelSoFarAboveEmin) {
  const channel::ModuleData like = module_named("TSOP4856");
  const double distance_m = bench_distance_m(like, bench_led());
  const double irradiance = 17.3 * std::sin(M_PI * 95 / 286) / (distance_m * distance_m);
  EXPECT_NEAR(20 * std::log10(irradiance / like.emin_mw_per_m2), strongest_above_emin_db, 0.1);
}

}  // namespace
}  // namespace sim
