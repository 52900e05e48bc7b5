// How often a fit is right of parts that it knows nothing of: the plan of `fit --plan`, played to
// parts of a generator that shares no code with the fit (hidden_part.hpp). A few each week; of
// COSYS_HIDDEN_PARTS parts where that is set.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "hidden_part.hpp"
#include "hidden_recording.hpp"
#include "sim/components/parts.hpp"
#include "sim/fit/fitted_module.hpp"
#include "sim/fit/plan_schedule.hpp"

namespace hidden {
namespace {

constexpr double level_of_many = 60;  // mW/m2
constexpr std::uint64_t seed = 21;    // none that the fit was made by

std::uint32_t wanted_parts(std::uint32_t usual) {
  const char* told = std::getenv("COSYS_HIDDEN_PARTS");
  return told == nullptr ? usual : static_cast<std::uint32_t>(std::atoi(told));
}

sim::Plan bench_plan() {
  const sim::PartSources parts{
      .folders = {COSYS_SOURCE_DIR "/scenarios"}, .carried = {}, .carrier = {}};
  const auto module = sim::load_module("TSOP4856", parts, "").data;
  const auto led = sim::load_led("TSAL6200", parts, "").data;
  return sim::plan_of(sim::schedule_for(module, led, 5));
}

struct Fitted {
  HiddenPart part;
  sim::FittedModule module;
};

std::vector<Fitted> fitted_parts(const PartDraw& draw, std::uint32_t wanted) {
  const sim::Plan plan = bench_plan();
  std::vector<Fitted> all;
  for (std::uint32_t first = 0; first < wanted; first += most_parts) {
    std::vector<HiddenPart> parts;
    for (std::uint32_t k = first; k < std::min<std::uint32_t>(wanted, first + most_parts); ++k)
      parts.push_back(draw_part(draw, k, plan));
    const auto recordings = recordings_of(plan, parts, level_of_many);
    for (std::size_t i = 0; i < parts.size(); ++i)
      all.push_back({parts[i], sim::fit_module({{plan, recordings[i], level_of_many}}, {})});
  }
  return all;
}

double truth_of(const HiddenPart& part, const std::string& key) {
  const auto number = std::ranges::find(module_numbers(), key, &ModuleNumber::key);
  return part.module.*number->member;
}

struct Told {
  int told = 0, inside = 0;
};

// README.md of sim/fit has what 200 parts printed: 1924 of 1999 inside.
TEST(FitOfManyHiddenParts, IntervalsHoldTheTruth) {
  const auto all = fitted_parts({.seed = seed}, wanted_parts(24));
  std::map<std::string, Told> constants;
  Told together;
  std::size_t blamed = 0;
  for (const Fitted& fitted : all) {
    blamed += fitted.module.misfits.empty() ? 0 : 1;
    for (const sim::FittedNumber& number : fitted.module.numbers) {
      if (!number.is_told) continue;
      const double truth = truth_of(fitted.part, number.key);
      const int inside = truth >= number.low && truth <= number.high ? 1 : 0;
      constants[number.key].inside += inside;
      together.inside += inside;
      ++constants[number.key].told;
      ++together.told;
    }
  }
  const auto parts = static_cast<int>(all.size());
  EXPECT_EQ(constants["agc_attack_db_per_ms"].told, parts);
  EXPECT_EQ(constants["agc_max_duty"].told, parts);
  EXPECT_EQ(constants["emin_mw_per_m2"].told, parts);
  EXPECT_GE(together.told, 8 * parts);
  EXPECT_GE(together.inside, 0.92 * together.told);
  for (const auto& [key, told] : constants)
    EXPECT_GE(told.inside, 0.9 * told.told - 1.6 * std::sqrt(0.09 * told.told)) << key;
  EXPECT_LE(blamed, 0.15 * static_cast<double>(all.size()));
}

// Kinds of broken rules that light can show whatever the part's other numbers are.
TEST(FitOfManyHiddenParts, SaysWhichRulesAreBroken) {
  for (const Broken broken :
       {Broken::steep_attack, Broken::harsh_long_bursts, Broken::linear_attack}) {
    const auto all = fitted_parts({.seed = seed, .broken = broken}, wanted_parts(4));
    const auto told =
        std::ranges::count_if(all, [](const Fitted& f) { return !f.module.misfits.empty(); });
    EXPECT_GE(static_cast<double>(told), 0.75 * static_cast<double>(all.size()))
        << static_cast<int>(broken);
  }
}

}  // namespace
}  // namespace hidden
