#include "sim/counting/holm.hpp"

#include "gtest/gtest.h"

namespace sim {
namespace {

TEST(Holm, GoesFromTheSmallestOn) {
  // Holm 1979: the smallest of four against alpha / 4, the next against alpha / 3 ...
  EXPECT_EQ(rejected_by_holm({0.012, 0.3, 0.016, 0.04}, 0.05),
            (std::vector<bool>{true, false, true, false}));
  EXPECT_EQ(rejected_by_holm({0.013, 0.3, 0.016, 0.04}, 0.05),
            (std::vector<bool>{false, false, false, false}));
  EXPECT_TRUE(rejected_by_holm({}, 0.05).empty());
}

}  // namespace
}  // namespace sim
