// Values of a scenario with their units.
#include "gtest/gtest.h"
#include "scenarios.hpp"

namespace sim {
namespace {

TEST(ScenarioUnits, AreTakenInTheFileAndBySet) {
  EXPECT_EQ(loaded("receiver.range_m = \"30 cm\"").base.receiver.range_m, 0.3);
  EXPECT_EQ(loaded("", {"receiver.range_m=30cm"}).base.receiver.range_m, 0.3);
  EXPECT_EQ(loaded("", {"receiver.range=30cm"}).base.receiver.range_m, 0.3);
  EXPECT_EQ(loaded("", {"ambient.daylight=500lux"}).base.ambient.daylight_lux, 500);
  EXPECT_EQ(loaded("", {"led.current=0.1A"}).base.led.current_ma, 100);
}

TEST(ScenarioUnits, AreTakenInSweeps) {
  const std::vector<double> values{0.5, 1, 1.5};
  EXPECT_EQ(loaded("[sweep]\nreceiver.range_m = \"0.5m:50cm:1.5m\"").sweep.front().values, values);
  EXPECT_EQ(loaded("", {"receiver.range=500,1000,1500mm"}).sweep.front().values, values);
}

TEST(ScenarioUnits, OfANameWithoutOneAreNeeded) {
  EXPECT_EQ(refusal("", {"receiver.range=3"}),
            "receiver.range in --set (no such key) did you mean receiver.range_m?");
  EXPECT_EQ(refusal("", {"receiver.range=3s"}),
            "receiver.range_m = 3s in --set (\"s\" is no m) write the number in m");
  // Two keys begin so: carrier_hz and carrier_duty.
  EXPECT_NE(refusal("", {"device=3m"}).find("no such key"), std::string::npos);
}

}  // namespace
}  // namespace sim
