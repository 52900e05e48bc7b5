// R15, R16, R18, R19 on the shipped TSOP4856: temperature, supply, ripple and colour as the sheet
// has them (Vishay 82459 rev 1.8); and the spread of units. Emin is measured at the module's
// output.
#include "channel/conditions.hpp"

#include <algorithm>
#include <vector>

#include "channel/data_sheet_bench.hpp"
#include "gtest/gtest.h"
#include "scenarios.hpp"
#include "sim/components/parts.hpp"
#include "sim/trial/trial.hpp"

namespace sim {
namespace {

using channel::Conditions;

channel::ModuleData tsop4856() {
  return load_module("TSOP4856", {{COSYS_SOURCE_DIR "/scenarios"}, {}, {}}, "").data;
}

double emin_under(const Conditions& conditions) {
  channel::Bench bench;
  bench.module = channel::under(conditions, tsop4856());
  return channel::measured_emin(bench, {});
}

// R15: ripple at f0 of 116 and 366 mV rms: .275 and .658 mW/m2 +- 25 %. Fig. 7.
TEST(ModuleConditions, R15_SupplyRippleRaisesEmin) {
  EXPECT_NEAR(emin_under({.ripple_mv_rms = 116}), 0.275, 0.25 * 0.275);
  EXPECT_NEAR(emin_under({.ripple_mv_rms = 366}), 0.658, 0.25 * 0.658);
}

// Ripple elsewhere than at f0 hardly matters: Fig. 7, 10 kHz (450 and 1000 mV) and 100 kHz.
TEST(ModuleConditions, R15_RippleAwayFromF0MattersLess) {
  const auto frequencies = channel::ripple_frequencies();
  EXPECT_NEAR(emin_under({.ripple_mv_rms = 450, .ripple_at = frequencies[1]}), 0.133, 0.1 * 0.133);
  EXPECT_NEAR(emin_under({.ripple_mv_rms = 1000, .ripple_at = frequencies[1]}), 0.54, 0.1 * 0.54);
  EXPECT_NEAR(emin_under({.ripple_mv_rms = 1000, .ripple_at = frequencies[2]}), 0.134, 0.1 * 0.134);
}

// R16: -30, 25, 90 degrees C: .157 .119 .172 mW/m2 +- 10 %. Fig. 9.
TEST(ModuleConditions, R16_TemperatureRaisesEminAtBothEnds) {
  EXPECT_NEAR(emin_under({.celsius = -30}), 0.157, 0.0157);
  EXPECT_NEAR(emin_under({.celsius = 25}), 0.119, 0.0119);
  EXPECT_NEAR(emin_under({.celsius = 90}), 0.172, 0.0172);
}

// R18: 850, 900, 940, 1000 nm: .10 .79 .983 .916 of the peak +- .03. Fig. 10.
TEST(ModuleConditions, R18_SpectralResponse) {
  const auto part = tsop4856();
  const double at_940 = part.spectral(940);
  EXPECT_NEAR(at_940, 0.983, 0.03);
  EXPECT_NEAR(channel::spectral_response(part, 850) * at_940, 0.10, 0.03);
  EXPECT_NEAR(channel::spectral_response(part, 900) * at_940, 0.79, 0.03);
  EXPECT_NEAR(channel::spectral_response(part, 1000) * at_940, 0.916, 0.03);
  EXPECT_EQ(channel::spectral_response(part, 940), 1);
}

// R19: 2.3 V .23, 2.5 V .14, from 2.7 V on .12 mW/m2; +- 10 % as R16. Fig. 12.
TEST(ModuleConditions, R19_LowSupplyRaisesEmin) {
  EXPECT_NEAR(emin_under({.supply_v = 2.3}), 0.23, 0.023);
  EXPECT_NEAR(emin_under({.supply_v = 2.5}), 0.14, 0.014);
  EXPECT_NEAR(emin_under({.supply_v = 2.7}), 0.12, 0.012);
  EXPECT_NEAR(emin_under({.supply_v = 5.5}), 0.12, 0.012);
}

TEST(ModuleConditions, APartWithoutCurvesIsTheSameUnderAll) {
  const channel::ModuleData plain;
  const auto hot = channel::under({.celsius = 80, .supply_v = 2.3, .ripple_mv_rms = 300}, plain);
  EXPECT_EQ(hot.emin_mw_per_m2, plain.emin_mw_per_m2);
  EXPECT_NEAR(hot.temperature_k, 353.15, 1e-9);
}

TEST(Population, UnitsSpanTheTolerancesOfTheSheet) {
  const Link link = link_of({"receiver.population=true"});
  double lowest = 1e9, highest = 0, most_sensitive = 1e9, least_sensitive = 0;
  for (std::uint32_t trial = 0; trial < 500; ++trial) {
    const auto unit = draw_unit(link, trial);
    ASSERT_TRUE(unit);
    most_sensitive = std::min(most_sensitive, static_cast<double>(unit->threshold));
    least_sensitive = std::max(least_sensitive, static_cast<double>(unit->threshold));
    // Of the integrator's length only f0 decides.
    lowest = std::min(lowest, 1.0 / unit->demodulator.integrator);
    highest = std::max(highest, 1.0 / unit->demodulator.integrator);
  }
  EXPECT_NEAR(highest / lowest, 1.05 / 0.95, 0.002);
  // 0.12 to 0.25 mW/m2 in the dark; the ambient light of the default adds to both in squares.
  EXPECT_GT(least_sensitive / most_sensitive, 1.3);
  EXPECT_LT(least_sensitive / most_sensitive, 0.25 / 0.12);
}

// A low supply raises typical and maximum alike: the units stay as far apart.
TEST(Population, UnitsStayApartUnderAnyCondition) {
  const auto spread = [](const Conditions& conditions) {
    const auto part = channel::under(conditions, tsop4856());
    return channel::unit_of(part, 0.5, 1 - 1e-9).emin_mw_per_m2 /
           channel::unit_of(part, 0.5, 0).emin_mw_per_m2;
  };
  EXPECT_NEAR(spread({}), 0.25 / 0.12, 1e-6);
  EXPECT_NEAR(spread({.supply_v = 2.2}), 0.25 / 0.12, 1e-6);
  EXPECT_NEAR(spread({.celsius = -30, .ripple_mv_rms = 300}), 0.25 / 0.12, 1e-6);
}

TEST(Population, IsSetAndSweptByWords) {
  EXPECT_TRUE(link_of({"receiver.population=true"}).population);
  EXPECT_FALSE(link_of({"receiver.population=false"}).population);
  EXPECT_EQ(loaded("", {"receiver.population=true,false"}).sweep.at(0).values,
            (std::vector<double>{1, 0}));
  EXPECT_EQ(
      refusal("", {"receiver.population=yes"}),
      "receiver.population = yes in --set (not false or parts or constants) use false or parts "
      "or constants");
}

TEST(Population, IsSweptByWordsInAFile) {
  const auto values = [](const std::string& list) {
    return loaded("[sweep]\nreceiver.population = " + list).sweep.at(0).values;
  };
  EXPECT_EQ(values("[\"parts\", \"constants\"]"), (std::vector<double>{1, 2}));
  EXPECT_EQ(values("[\"constants\", false, \"parts\"]"), (std::vector<double>{2, 0, 1}));
  EXPECT_EQ(values("[false, true]"), (std::vector<double>{0, 1}));
  EXPECT_EQ(refusal("[sweep]\nreceiver.population = [false, \"all\"]"),
            "receiver.population = \"all\" in x.toml:2 (not false or parts or constants) use false "
            "or parts or constants");
  EXPECT_EQ(refusal("[sweep]\nreceiver.range_m = [1, true]"),
            "sweep.receiver.range_m in x.toml:2 (a list that is not of numbers where a range or "
            "list is expected) write \"1:1:20\" or [1, 2, 5]");
}

TEST(Population, IsOffByDefaultAndMovesNoOtherDraw) {
  EXPECT_FALSE(draw_unit(link_of({}), 0));
  Link on = link_of({"receiver.population=true"}), off = link_of({});
  on.point = off.point;
  EXPECT_EQ(transmit(on, 3).line, transmit(off, 3).line);
  const Transmission sent = transmit(on, 3);
  EXPECT_EQ(chain_input(on, 3, sent).noise_seed, chain_input(off, 3, sent).noise_seed);
}

// At the edge of the range some units hear and some do not: neither all nor none is lost.
TEST(Population, ARangeAtWhichAllTypicalUnitsHearLosesSome) {
  const std::vector<std::string> at = {"receiver.range_m=19", "module.agc_attack_db_per_ms=0",
                                       "simulation.warmup_messages=0"};
  auto spread = at;
  spread.emplace_back("receiver.population=true");
  EXPECT_EQ(run_group(link_of(at), 0, 8).tally.n_frames_lost, 0u);
  Tally tally;
  for (std::uint32_t first = 0; first < 64; first += 8)
    tally += run_group(link_of(spread), first, 8).tally;
  EXPECT_GT(tally.n_frames_lost, 3u);
  EXPECT_LT(tally.n_frames_lost, 61u);
}

TEST(PopulationDeterminism, TheUnitThatIsTracedIsTheUnitThatWasCounted) {
  const Link link = link_of({"receiver.population=true", "receiver.range_m=17",
                             "module.agc_attack_db_per_ms=0", "simulation.warmup_messages=0"});
  Tally one_by_one;
  for (std::uint32_t trial = 40; trial < 48; ++trial) {
    const Transmission sent = transmit(link, trial);
    const auto unit = draw_unit(link, trial);
    auto pin = channel::propagate_alone(link.chain, chain_input(link, trial, sent, unit));
    one_by_one += count(link, sent, receive(link, trial, std::move(pin)));
  }
  EXPECT_EQ(one_by_one, run_group(link, 40, 8).tally);
}

}  // namespace
}  // namespace sim
