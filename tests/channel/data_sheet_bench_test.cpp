// The bench measures a part's slow AGC once that has settled, so how fast it moves does not matter.
#include "channel/data_sheet_bench.hpp"

#include <gtest/gtest.h>

namespace channel {
namespace {

constexpr double e_mw_per_m2 = 100;
constexpr double cycles = 150;  // a long burst of any part

/// Of the shortest period that is tolerated.
double measured_period_s(double attack_db_per_ms, double hold_ms) {
  Bench bench;
  bench.module.agc_attack_db_per_ms = attack_db_per_ms;
  bench.module.agc_hold_ms = hold_ms;
  const double burst_s = cycles / bench.module.centre_hz;
  return shortest_period(bench, burst_s, e_mw_per_m2, 1.01 * burst_s, 50 * burst_s);
}

/// The gain comes back as far as it fell: (period - burst - hold) d = burst (1 - d).
double balanced_period_s(double hold_ms) {
  const ModuleData module;
  const double burst_s = cycles / module.centre_hz;
  return burst_s / module.agc_max_duty + hold_ms * 1e-3;
}

// Activity lasts some cycles longer than the burst, and a burst counts as reported that the gain
// lets go of behind its middle.
TEST(DataSheetBench, FindsThePeriodAtWhichTheGainBalancesHoweverFastItIs) {
  for (const double hold_ms : {0.0, 9.2}) {
    const double slow = measured_period_s(0.1, hold_ms), fast = measured_period_s(1, hold_ms);
    EXPECT_NEAR(slow / fast, 1, 0.02) << hold_ms;
    EXPECT_NEAR(fast / balanced_period_s(hold_ms), 1, 0.04) << hold_ms;
  }
}

}  // namespace
}  // namespace channel
