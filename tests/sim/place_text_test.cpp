#include "sim/result/place_text.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace {

TEST(PlaceText, HasEachAxisWithItsUnit) {
  const std::vector<sim::Axis> axes{
      {"receiver.range_m", "m", "distance", {2.2, 10}},
      {"receiver.module", "", "module", {0, 1}, {"TSSP4056", "TSOP4856"}},
      {"noise.scale", "1", "noise", {0.5}}};
  EXPECT_EQ(sim::place_text(axes, {2.2, 1, 0.5}),
            "receiver.range_m = 2.2 m, receiver.module = TSOP4856, noise.scale = 0.5");
  EXPECT_EQ(sim::place_text({}, {}), "");
}

}  // namespace
