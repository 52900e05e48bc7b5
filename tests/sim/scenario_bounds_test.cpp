// The bounds of the keys keep out what has no answer: at their ends the light is still a number.
#include <fmt/format.h>

#include <cmath>

#include "channel/band_pass.hpp"
#include "gtest/gtest.h"
#include "protocol/uart_receivers.hpp"
#include "scenarios.hpp"
#include "sim/scenario/keys.hpp"

namespace sim {
namespace {

std::vector<double> ends_of(const Key& key) {
  const Range& range = key.facts.range;
  return {range.low_open ? std::nextafter(range.low, range.high) : range.low, range.high};
}

void expect_numbers(const OperatingPoint& point, const std::string& where) {
  EXPECT_TRUE(std::isfinite(point.irradiance_mw_per_m2)) << where;
  EXPECT_GE(point.irradiance_mw_per_m2, 0) << where;
  EXPECT_FALSE(std::isnan(point.snr_db)) << where;
  EXPECT_FALSE(std::isnan(point.ebn0_db)) << where;
}

TEST(ScenarioBounds, EveryEndOfAKeyThatIsAcceptedHasAnOperatingPoint) {
  for (const Key& key : scenario_keys()) {
    if (!key.is_number()) continue;
    for (const double end : ends_of(key)) {
      const std::string set = fmt::format("{}={}", key.name(), end);
      if (refusal("", {set}) == "accepted") expect_numbers(link_of({set}).operating, set);
    }
  }
}

TEST(ScenarioBounds, EveryCornerOfTheGeometryHasFiniteLight) {
  const char* const names[] = {"receiver.range_m", "receiver.height_mm", "led.height_mm",
                               "led.elevation_deg", "receiver.tilt_deg"};
  for (unsigned corner = 0; corner < 1U << std::size(names); ++corner) {
    Scenario s = loaded("").base;
    for (std::size_t i = 0; i < std::size(names); ++i) {
      const Key& key = *find_key(names[i]);
      key.number(s) = ends_of(key)[(corner >> i) & 1U];
    }
    EXPECT_TRUE(std::isfinite(light_of(s).total().value)) << corner;
  }
}

template <class Part>
std::vector<KeyFacts> facts_of(const PartKeys<Part>& keys) {
  std::vector<KeyFacts> all;
  for (const auto& number : keys.numbers) all.push_back(number.facts);
  for (const auto& curve : keys.curves) all.insert(all.end(), {curve.x, curve.y});
  return all;
}

// What must be above 0 has a least value that a thing can have; 1e-300 is above 0 too.
TEST(ScenarioBounds, NoKeyBeginsRightAboveZero) {
  std::vector<KeyFacts> all = facts_of(module_keys());
  for (const KeyFacts& facts : facts_of(led_keys())) all.push_back(facts);
  for (const Key& key : scenario_keys()) all.push_back(key.facts);
  for (const KeyFacts& facts : all)
    EXPECT_FALSE(facts.range.low_open && facts.range.low == 0) << facts.name;
}

TEST(ScenarioBounds, BandPassOfTheSmallestQIsFinite) {
  const double q = ends_of(*find_key("module.q"))[0];
  const auto design = channel::design_band_pass(dsp::Hertz(56000), q, dsp::Hertz(600e3));
  for (const auto& step : {design.output, design.integral, design.third, design.two_thirds})
    EXPECT_TRUE(std::isfinite(step.u) && std::isfinite(step.v) && std::isfinite(step.x));
}

TEST(ScenarioBounds, EveryUartReceiverCanBeNamed) {
  EXPECT_GE(protocol::uart_receivers().size(), 2U);
  for (const auto& receiver : protocol::uart_receivers())
    EXPECT_EQ(refusal("", {"uart.receiver=" + std::string(receiver.name)}), "accepted");
}

}  // namespace
}  // namespace sim
