// Units as people read them.
#include "sim/text/unit_text.hpp"

#include <gtest/gtest.h>

namespace sim {
namespace {

TEST(UnitText, IsThatOfFilesButOfPureNumbers) {
  EXPECT_EQ(with_unit("3", "mW/m2"), "3 mW/m2");
  EXPECT_EQ(with_unit("3", "1e-6"), "3 ppm");
  EXPECT_EQ(bracketed_unit("m"), "[m]");
  for (const char* none : {"", "1"}) {
    EXPECT_EQ(with_unit("3", none), "3");
    EXPECT_EQ(bracketed_unit(none), "");
  }
}

}  // namespace
}  // namespace sim
