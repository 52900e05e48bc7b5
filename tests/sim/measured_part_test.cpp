// Measured modules as part files: read again they have the numbers that were measured, and all
// others of the module that they are like, with their bounds and sources.
#include "sim/fit/measured_part.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "sim/components/part_reader.hpp"
#include "sim/scenario/keys.hpp"

namespace sim {
namespace {

const PartSources catalogue{.folders = {std::filesystem::path(COSYS_SOURCE_DIR) / "scenarios"},
                            .carried = {},
                            .carrier = {}};

FittedNumber told_number(const std::string& key, double value, double low, double high) {
  return {.key = key, .value = value, .low = low, .high = high, .is_told = true, .more = ""};
}

FittedModule some_fit() {
  FittedModule fit;
  fit.numbers = {told_number("centre_hz", 56123.4567, 56080.1678, 56166.7321),
                 told_number("emin_mw_per_m2", 0.4, 0.38, 0.42),
                 told_number("agc_attack_db_per_ms", 0.1723456789, 0.158, 0.187),
                 {.key = "agc_range_db", .value = 120, .low = 50, .high = 120, .more = "light"}};
  return fit;
}

channel::ModuleData read_again(const std::string& text) {
  return read_part_text(module_keys(), text, "mine.toml", "mine");
}

const channel::NumberBounds* bounds_of(const channel::ModuleData& part, const std::string& number) {
  const auto found = std::ranges::find(part.bounds, number, &channel::NumberBounds::number);
  return found == part.bounds.end() ? nullptr : &*found;
}

TEST(MeasuredPart, HasWhatWasMeasuredAndTheRestOfWhatItIsLike) {
  for (const PartFile& file : list_parts(catalogue.folders)) {
    if (file.kind != "module" || file.name.starts_with("ideal")) continue;
    const auto like = load_module(file.name, catalogue, "");
    const FittedModule fit = some_fit();
    const channel::ModuleData part = read_again(measured_part_text(fit, like, "mine", "c.csv"));
    for (const auto& number : module_keys().numbers) {
      const std::string& key = number.facts.name;
      const auto own = std::ranges::find(fit.numbers, key, &FittedNumber::key);
      const bool is_told = own != fit.numbers.end() && own->is_told;
      const bool is_spread = key == "centre_tolerance" || key == "emin_max_mw_per_m2";
      const double wanted = is_told ? own->value : is_spread ? 0 : like.data.*number.member;
      EXPECT_NEAR(part.*number.member, wanted, is_told ? 1e-5 * wanted : 0) << file.name << key;
      const channel::NumberBounds* bounds = bounds_of(part, key);
      const channel::NumberBounds* others = bounds_of(like.data, key);
      if (is_told || is_spread) {
        EXPECT_EQ(bounds != nullptr, is_told) << file.name << key;
        continue;
      }
      ASSERT_EQ(bounds != nullptr, others != nullptr) << file.name << key;
      if (bounds == nullptr) continue;
      EXPECT_EQ(bounds->low, others->low);
      EXPECT_EQ(bounds->high, others->high);
      EXPECT_EQ(bounds->distribution, others->distribution);
    }
    for (const auto& curve : module_keys().curves) {
      EXPECT_EQ((part.*curve.member).x, (like.data.*curve.member).x) << file.name << curve.name;
      EXPECT_EQ((part.*curve.member).y, (like.data.*curve.member).y) << file.name << curve.name;
    }
  }
}

TEST(MeasuredPart, IntervalsHoldWhatTheyHeld) {
  const auto like = load_module("TSOP4856", catalogue, "");
  const FittedModule fit = some_fit();
  const channel::ModuleData part = read_again(measured_part_text(fit, like, "mine", "c.csv"));
  for (const FittedNumber& number : fit.numbers) {
    if (!number.is_told) continue;
    const channel::NumberBounds* bounds = bounds_of(part, number.key);
    ASSERT_NE(bounds, nullptr) << number.key;
    EXPECT_LE(bounds->low, number.low);
    EXPECT_GE(bounds->high, number.high);
    EXPECT_TRUE(bounds->is_measured) << number.key;
    EXPECT_FALSE(bounds->breaks_rule) << number.key;
  }
  EXPECT_FALSE(bounds_of(part, "agc_range_db")->is_measured) << "hardly told";
  EXPECT_EQ(bounds_of(part, "agc_attack_db_per_ms")->distribution,
            channel::Distribution::log_uniform);
  EXPECT_EQ(bounds_of(part, "centre_hz")->distribution, channel::Distribution::uniform);
}

// So that whoever runs it later hears of it.
TEST(MeasuredPart, SaysInEachSourceThatItDoesNotFollowTheRule) {
  const auto like = load_module("TSOP4856", catalogue, "");
  FittedModule fit = some_fit();
  fit.misfits = {{"short bursts", "reported 20 ms later"}};
  const channel::ModuleData part = read_again(measured_part_text(fit, like, "mine", "c.csv"));
  EXPECT_TRUE(bounds_of(part, "centre_hz")->breaks_rule);
  EXPECT_TRUE(bounds_of(part, "centre_hz")->is_measured);
  EXPECT_FALSE(bounds_of(part, "agc_range_db")->breaks_rule) << "hardly told";
}

// What is hardly told goes with the other numbers, and a doubt that the recording has settled is
// not drawn.
TEST(MeasuredPart, HasOfWhatIsHardlyToldWhatFitsBest) {
  const auto like = load_module("TSOP4856", catalogue, "");
  FittedModule fit = some_fit();
  const channel::NumberBounds given = *bounds_of(like.data, "agc_range_db");
  const auto part_for = [&](double value, double low, double high) {
    fit.numbers.back().value = value;
    fit.numbers.back().low = low;
    fit.numbers.back().high = high;
    const std::string text = measured_part_text(fit, like, "mine", "c.csv");
    EXPECT_NE(
        text.find("hardly told by c.csv: what fits best, within what it leaves; TSOP4856 has 120"),
        std::string::npos);
    return read_again(text);
  };
  const channel::ModuleData part = part_for(90, 72, 200);
  EXPECT_EQ(part.agc_range_db, 90);
  EXPECT_EQ(bounds_of(part, "agc_range_db")->low, 72);
  EXPECT_EQ(bounds_of(part, "agc_range_db")->high, given.high) << "of what any part may have";
  EXPECT_EQ(bounds_of(part_for(60, 20, 140), "agc_range_db")->low, given.low);
  EXPECT_EQ(part_for(130, 125, 140).agc_range_db, given.high);
}

TEST(MeasuredPart, OneOfTwoThatExcludeEachOtherHasThePlaceOfTheOther) {
  const auto like = load_module("TSOP57256", catalogue, "");
  const bool in_ms = like.data.agc_long_burst_ms > 0;
  FittedModule fit = some_fit();
  fit.numbers.push_back(
      told_number(in_ms ? "agc_long_burst_cycles" : "agc_long_burst_ms", 50, 40, 60));
  const channel::ModuleData part = read_again(measured_part_text(fit, like, "mine", "c.csv"));
  EXPECT_EQ(in_ms ? part.agc_long_burst_cycles : part.agc_long_burst_ms, 50);
  EXPECT_EQ(part.agc_long_burst_ms > 0, !in_ms);
}

TEST(MeasuredPart, SaysOnTopWhatItIs) {
  const auto like = load_module("TSOP4856", catalogue, "");
  FittedModule fit = some_fit();
  fit.not_apart = {"agc_hold_ms and agc_max_duty: longer gaps would tell them"};
  fit.misfits = {{"short bursts", "reported 20 ms later than the rule says"}};
  const std::string text = measured_part_text(fit, like, "mine", "c\n[x].csv");
  EXPECT_EQ(text.substr(0, text.find("name =")),
            "# Measured by cosys-sim fit: a unit like TSOP4856, recorded in c [x].csv.\n"
            "# Measured, each with its interval of 95 %: centre_hz, emin_mw_per_m2 and "
            "agc_attack_db_per_ms.\n"
            "# Hardly told, what fits best: agc_range_db.\n"
            "# All others are those of TSOP4856.\n"
            "# Not told apart: agc_hold_ms and agc_max_duty: longer gaps would tell them.\n"
            "# The part does not follow the rule: short bursts: reported 20 ms later than the rule "
            "says.\n");
  EXPECT_EQ(read_again(text).name, "mine");
  fit.numbers.clear();
  EXPECT_NE(measured_part_text(fit, like, "mine", "c")
                .find("# No number is measured.\n# All others are those of TSOP4856.\n"),
            std::string::npos);
}

}  // namespace
}  // namespace sim
