// Acceptance tests of the data sheets on every receiver module that the project ships: R1 to R3
// and R9; TSOP4856 alone has all of them in tests/channel/receiver_module_test.cpp.
#include <cmath>
#include <string>
#include <vector>

#include "channel/data_sheet_bench.hpp"
#include "gtest/gtest.h"
#include "sim/components/parts.hpp"

namespace {

namespace fs = std::filesystem;
using channel::ModuleData;

const sim::PartRoots shipped{fs::path(COSYS_SOURCE_DIR) / "scenarios"};

ModuleData shipped_module(const std::string& name) {
  return sim::load_module(name, {shipped, {}, {}}, "").data;
}

std::vector<ModuleData> shipped_modules() {
  std::vector<ModuleData> modules;
  for (const auto& part : sim::list_parts(shipped)) {
    if (part.kind != "module") continue;
    const ModuleData module = shipped_module(part.name);
    if (!channel::is_matched(module)) modules.push_back(module);
  }
  return modules;
}

/// The test signal of the sheets' Fig. 1; parts that ask for a gap in ms (AGC5, AGC6) get that too.
channel::BurstTrain signal_for(const ModuleData& module) {
  channel::BurstTrain train = channel::test_signal(module.centre_hz);
  train.period_s += module.agc_hold_ms * 1e-3;
  return train;
}

/// Four irradiances a decade from just above Emin to Emax, mW/m2.
std::vector<double> working_range(const ModuleData& module) {
  std::vector<double> all;
  for (double e = 1.04 * module.emin_mw_per_m2; e < module.emax_w_per_m2 * 1e3;
       e *= std::pow(10.0, 0.25))
    all.push_back(e);
  return all;
}

// R1: Emin of the characteristics table comes out of the bench.
TEST(PartAcceptance, MeasuredR1_EminOfEveryModuleIsThatOfItsFile) {
  ASSERT_GE(shipped_modules().size(), 17u);
  for (const ModuleData& module : shipped_modules())
    EXPECT_NEAR(measured_emin({.module = module}, signal_for(module)) / module.emin_mw_per_m2, 1,
                0.1)
        << module.name;
}

struct Window {
  const char* name;
  double least, most;  // cycles
};

// R2: output less input width from Emin to Emax. Vishay 82459, 82491, 82489, 82434, 82836, 82868
// Fig. 1: -5 to 6 cycles; 82834 Fig. 1: -4 to 4.
constexpr Window widths[] = {{"TSOP4856", -5, 6},  {"TSOP4456", -5, 6},  {"TSOP38256", -5, 6},
                             {"TSOP38456", -5, 6}, {"TSOP34856", -5, 6}, {"TSOP57256", -5, 6},
                             {"TSOP94256", -4, 4}, {"TSOP94456", -4, 4}, {"TSOP94656", -5, 6},
                             {"TSSP96056", -5, 6}, {"TSSP4056", -5, 6}};

TEST(PartAcceptance, MeasuredR2_PulseWidthsStayInTheWindow) {
  for (const Window& window : widths) {
    const ModuleData module = shipped_module(window.name);
    const auto train = signal_for(module);
    for (const double e : working_range(module)) {
      const auto pulses = channel::pulses_of(output_of({.module = module}, train, e));
      ASSERT_EQ(pulses.size(), 20u) << window.name << " " << e;
      for (const auto& pulse : pulses) {
        const double stretch = (pulse.width() - train.burst_s) * module.centre_hz;
        EXPECT_GE(stretch, window.least) << window.name << " " << e;
        EXPECT_LE(stretch, window.most) << window.name << " " << e;
      }
    }
  }
}

// R3: output delay. The same figures: 7 to 15 cycles; 82834: 11 to 17 (AGC2), 7 to 13 (AGC4).
constexpr Window delays[] = {{"TSOP4856", 7, 15},   {"TSOP4456", 7, 15},  {"TSOP38256", 7, 15},
                             {"TSOP38456", 7, 15},  {"TSOP34856", 7, 15}, {"TSOP57256", 7, 15},
                             {"TSOP94256", 11, 17}, {"TSOP94456", 7, 13}};

TEST(PartAcceptance, MeasuredR3_OutputDelaysStayInTheWindow) {
  for (const Window& window : delays) {
    const ModuleData module = shipped_module(window.name);
    const auto train = signal_for(module);
    for (const double e : working_range(module)) {
      const auto pulses = channel::pulses_of(output_of({.module = module}, train, e));
      ASSERT_EQ(pulses.size(), 20u) << window.name << " " << e;
      for (int i = 0; i < train.bursts; ++i) {
        const double delay =
            (pulses[static_cast<std::size_t>(i)].start - burst_start(train, i)) * module.centre_hz;
        EXPECT_GT(delay, window.least) << window.name << " " << e;
        EXPECT_LT(delay, window.most) << window.name << " " << e;
      }
    }
  }
}

/// When a continuous carrier of 1.2 seconds is last reported, in seconds after its beginning.
double reported_until(const ModuleData& module, double e_mw_per_m2) {
  const channel::BurstTrain steady{
      .carrier_hz = module.centre_hz, .burst_s = 1.2, .period_s = 1.201, .bursts = 1};
  const auto pulses = channel::pulses_of(output_of({.module = module}, steady, e_mw_per_m2));
  return pulses.empty() ? 0 : pulses.back().end - burst_start(steady, 0);
}

// R9: "continuous signals are suppressed" by AGC1 to AGC6 (82459 p. 5 and its sisters), within a
// second of ours; fixed gain (AGC0: 82737, 82868; no AGC: Sharp OP06012) reports them to the end.
TEST(PartAcceptance, MeasuredR9_ContinuousCarrierIsSuppressedUnlessTheGainIsFixed) {
  for (const ModuleData& module : shipped_modules())
    for (const double e : {3 * module.emin_mw_per_m2, 30.0, 1e3 * module.emax_w_per_m2}) {
      const double until = reported_until(module, e);
      if (module.agc_attack_db_per_ms == 0)
        EXPECT_NEAR(until, 1.2, 1e-3) << module.name << " " << e;
      else
        EXPECT_LT(until, 1) << module.name << " " << e;
    }
}

// The sheets that have fixed gain say so; no other part of the catalogue may be without an AGC.
TEST(PartAcceptance, MeasuredFixedGainIsOfTheseThree) {
  std::string fixed;
  for (const ModuleData& module : shipped_modules())
    if (module.agc_attack_db_per_ms == 0) fixed += module.name + " ";
  EXPECT_EQ(fixed, "GP1UX51QS TSSP4056 TSSP96056 ");
}

}  // namespace
