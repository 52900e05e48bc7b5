// What a fit says of recordings of hidden parts, beside what they are.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "hidden_part.hpp"
#include "hidden_recording.hpp"
#include "sim/failure.hpp"
#include "sim/fit/fitted_module.hpp"

namespace hidden {
namespace {

constexpr double carrier_hz = 56000;
constexpr double first_level = 300;  // mW/m2

/// Adds a step behind some dark.
void add(sim::Plan& plan, double dark_ms, sim::PlanStep step) {
  step.start_ms = plan.steps.empty() ? dark_ms : sim::end_ms(plan.steps.back()) + dark_ms;
  plan.steps.push_back(step);
}

/// A minute that tells how fast the gain falls and what it tolerates.
sim::Plan short_plan() {
  sim::Plan plan;
  for (const double db : {0.0, -14.0, -28.0, -42.0, -56.0})
    add(plan, 2500, {0, carrier_hz, 50000, 0, 1, db});
  for (const double db : {-48.0, -54.0, -57.0, -60.0, -63.0})
    for (const double carrier : {1.0, 0.95, 1.05})
      add(plan, 120, {0, carrier * carrier_hz, 30, 530, 15, db});
  for (const std::uint64_t off : {800u, 550u, 380u, 260u, 180u})
    add(plan, 2500, {0, carrier_hz, 150, off, 80, -38});
  return plan;
}

const sim::FittedNumber& number(const sim::FittedModule& fitted, const std::string& key) {
  return *std::ranges::find(fitted.numbers, key, &sim::FittedNumber::key);
}

/// Parts without hold and with some margin: what a plan of a minute tells.
HiddenPart usual_part(std::uint32_t which, const sim::Plan& plan) {
  HiddenPart part = draw_part({.seed = 11}, which, plan);
  part.module.agc_hold_ms = 0;
  part.module.agc_free_cycles = 0;
  part.module.agc_margin_db = 3;
  part.module.agc_attack_db_per_ms = std::max(part.module.agc_attack_db_per_ms, 0.15);
  part.module.agc_max_duty = std::clamp(part.module.agc_max_duty, 0.2, 0.4);
  return part;
}

TEST(FitOfHiddenParts, FindsHowTheGainFalls) {
  const sim::Plan plan = short_plan();
  std::vector<HiddenPart> parts;
  for (std::uint32_t which = 0; which < 4; ++which) parts.push_back(usual_part(which, plan));
  const auto recordings = recordings_of(plan, parts, first_level);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const sim::FittedModule fitted =
        sim::fit_module({{plan, recordings[i], first_level}}, channel::ModuleData{});
    const auto& attack = number(fitted, "agc_attack_db_per_ms");
    EXPECT_TRUE(attack.is_told) << i;
    EXPECT_LE(attack.low, parts[i].module.agc_attack_db_per_ms) << i;
    EXPECT_GE(attack.high, parts[i].module.agc_attack_db_per_ms) << i;
    const auto& emin = number(fitted, "emin_mw_per_m2");
    EXPECT_TRUE(emin.is_told) << i;
    EXPECT_NEAR(emin.value / parts[i].module.emin_mw_per_m2, 1, 0.25)
        << i;  // levels are off by 10 %
    EXPECT_NEAR(fitted.captures[0].clock_error, parts[i].clock_error, 1e-5) << i;
    EXPECT_NEAR(fitted.captures[0].start_s, parts[i].start_s, 6 / carrier_hz)
        << i;  // the integrator is not told
    ASSERT_TRUE(fitted.output_width) << i;
    EXPECT_LT(fitted.output_width->least_cycles, fitted.output_width->most_cycles) << i;
    EXPECT_NEAR(fitted.output_width->most_cycles, 3, 4) << i;
  }
}

sim::PinRecording recording_in(const HiddenPart& part, const sim::Plan& plan, double level) {
  return recordings_of(plan, {&part, 1}, level).front();
}

// A gain that falls no further lets a carrier through that is stronger than its range: the plan
// alone does not reach it, the same one in stronger light does. Emin grows under a lamp.
TEST(FitOfHiddenParts, SeveralCapturesTellRangeAndAmbientLight) {
  const sim::Plan plan = short_plan();
  HiddenPart part = usual_part(1, plan);
  part.module.agc_range_db = 75;
  part.module.emin_mw_per_m2 = 0.2;
  constexpr double nearer = 15.85, lamp_w_per_m2 = 5;  // 24 dB
  std::vector<sim::LightCapture> captures{
      {plan, recording_in(part, plan, first_level), first_level}};
  const auto alone = sim::fit_module(captures, channel::ModuleData{});
  EXPECT_FALSE(number(alone, "agc_range_db").is_told);
  EXPECT_LE(number(alone, "agc_range_db").low, 75);
  EXPECT_FALSE(number(alone, "ambient_k").is_told);

  captures.push_back({plan, recording_in(part, plan, nearer * first_level), std::nullopt});
  part.ambient_w_per_m2 = lamp_w_per_m2;
  captures.push_back({plan, recording_in(part, plan, first_level), std::nullopt, lamp_w_per_m2});
  const auto all = sim::fit_module(captures, channel::ModuleData{});
  for (const auto& [key, truth] : {std::pair{"agc_range_db", 75.0},
                                   {"ambient_k", part.module.ambient_k},
                                   {"agc_attack_db_per_ms", part.module.agc_attack_db_per_ms}}) {
    const sim::FittedNumber& fitted = number(all, key);
    EXPECT_TRUE(fitted.is_told) << key;
    EXPECT_LE(fitted.low, truth) << key;
    EXPECT_GE(fitted.high, truth) << key;
  }
  const sim::FittedNumber& range = number(all, "agc_range_db");
  EXPECT_LT(range.high - range.low, 2 * 14) << "carriers are 14 dB apart";
  EXPECT_NEAR(all.captures[1].level_db, 24, 1.2) << "not said, found";
  EXPECT_LT(all.captures[2].level_db, -3) << "seems weaker";
  EXPECT_NEAR(all.strongest_db, 24, 1.2) << "not of the lamp's";
}

// Weak bursts behind a carrier of which the output never let go come back when the gain has, from
// as far down as it goes: that tells the range to less than the 8 dB between carriers.
TEST(FitOfHiddenParts, BurstsBehindCarriersTellTheRange) {
  sim::Plan plan = short_plan();
  for (const double db : {-24.0, -16.0, -8.0, 0.0}) {
    add(plan, 2500, {0, carrier_hz, 50000, 0, 1, db});
    add(plan, 3.5, {0, carrier_hz, 20, 176, 300, db - 16});
  }
  HiddenPart part = usual_part(1, plan);
  part.module.agc_range_db = 51;
  part.module.emin_mw_per_m2 = 0.2;  // the strongest is 64 dB above
  const auto fitted = sim::fit_module({{plan, recording_in(part, plan, first_level), first_level}},
                                      channel::ModuleData{});
  const sim::FittedNumber& range = number(fitted, "agc_range_db");
  EXPECT_TRUE(range.is_told);
  EXPECT_LE(range.low, 51);
  EXPECT_GE(range.high, 51);
  EXPECT_LT(range.high - range.low, 8);
}

TEST(FitOfHiddenParts, SaysWhereAPartBreaksTheRule) {
  sim::Plan plan = short_plan();
  for (const double db : {-7.0, -21.0, -35.0, -49.0})
    add(plan, 2500, {0, carrier_hz, 50000, 0, 1, db});
  for (const Broken broken : {Broken::nothing, Broken::linear_attack}) {
    HiddenPart part = usual_part(0, plan);
    part.broken = broken;
    const auto fitted = sim::fit_module(
        {{plan, recording_in(part, plan, first_level), first_level}}, channel::ModuleData{});
    if (broken == Broken::nothing) {
      EXPECT_TRUE(fitted.misfits.empty());
      continue;
    }
    ASSERT_FALSE(fitted.misfits.empty());
    EXPECT_TRUE(fitted.misfits.front().what.starts_with("long carriers"));
  }
}

// Short gaps of trains show the first rate at which a gain comes back, seldom weak bursts right
// behind a carrier the later one.
TEST(FitOfHiddenParts, SaysThatAGainComesBackAtTwoRates) {
  sim::Plan plan = short_plan();
  for (const std::uint64_t off : {380u, 260u, 180u, 130u, 95u, 70u})
    add(plan, 2500, {0, carrier_hz, 150, off, 300, -50});
  for (const auto& [carrier_db, weaker_db, period_ms] :
       {std::array{-8., 36., 32.}, {0., 42., 35.}, {-8., 28., 45.}, {-8., 22., 38.}}) {
    add(plan, 2500, {0, carrier_hz, 67200, 0, 1, carrier_db});
    const auto dark = static_cast<std::uint64_t>(1e-3 * period_ms * carrier_hz) - 20;
    add(plan, period_ms, {0, carrier_hz, 20, dark, 40, carrier_db - weaker_db});
  }
  for (const Broken broken : {Broken::nothing, Broken::two_releases}) {
    HiddenPart part = usual_part(2, plan);
    part.broken = broken;
    const auto fitted = sim::fit_module(
        {{plan, recording_in(part, plan, first_level), first_level}}, channel::ModuleData{});
    const bool is_told = std::ranges::any_of(fitted.misfits, [](const sim::FitMisfit& misfit) {
      return misfit.what.starts_with("seldom bursts behind a carrier");
    });
    EXPECT_EQ(is_told, broken == Broken::two_releases);
  }
}

// A fifth of what a long burst is charged adds up where short ones come densely, and many.
TEST(FitOfHiddenParts, SaysThatShortBurstsAreCharged) {
  sim::Plan plan = short_plan();
  for (const std::uint64_t i : {0U, 1U, 2U, 3U, 4U, 5U})
    add(plan, 1500, {0, carrier_hz, 36 + 8 * i, 45 - 4 * i, 1000, -52});
  for (const Broken broken : {Broken::nothing, Broken::charged_short_bursts}) {
    HiddenPart part = usual_part(0, plan);
    part.broken = broken;
    part.module.agc_min_gap_cycles = 20;
    part.module.agc_hold_ms = 10;
    const auto fitted = sim::fit_module(
        {{plan, recording_in(part, plan, first_level), first_level}}, channel::ModuleData{});
    const bool is_told = std::ranges::any_of(fitted.misfits, [](const sim::FitMisfit& misfit) {
      return misfit.what.starts_with("trains of many bursts");
    });
    EXPECT_EQ(is_told, broken == Broken::charged_short_bursts);
  }
}

// Trains of one length of bursts tell how much dark each needs: of free cycles, of a hold, or of
// some of both.
TEST(FitOfHiddenParts, SaysWhatIsNotToldApart) {
  const sim::Plan plan = short_plan();
  HiddenPart part = usual_part(2, plan);
  part.module.agc_hold_ms = 2;
  const auto fitted = sim::fit_module({{plan, recording_in(part, plan, first_level), first_level}},
                                      channel::ModuleData{});
  ASSERT_EQ(fitted.not_apart.size(), 1U);
  EXPECT_EQ(fitted.not_apart[0],
            "agc_free_cycles and agc_hold_ms are told together only: what would part them is short "
            "bursts behind a carrier, at gaps of 3 to 30 ms");
}

TEST(FitOfHiddenParts, RefusesAPlanWithoutEnd) {
  sim::Plan plan = short_plan();
  plan.steps.back().repeats = 1'000'000'000'000;
  EXPECT_THROW(sim::fit_module({{plan, {}, {}}}, channel::ModuleData{}), sim::Failure);
}

TEST(FitOfHiddenParts, RefusesARecordingOfSomethingElse) {
  sim::PinRecording recording;
  for (int i = 0; i < 300; ++i) recording.pulses.push_back({i * 0.013, i * 0.013 + 0.001});
  EXPECT_THROW(sim::fit_module({{short_plan(), {}, {}}}, channel::ModuleData{}), sim::Failure);
  EXPECT_THROW(sim::fit_module({{short_plan(), recording, {}}}, channel::ModuleData{}),
               sim::Failure);
}

}  // namespace
}  // namespace hidden
