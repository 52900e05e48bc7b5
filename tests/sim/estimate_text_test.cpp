// Ratios as people read them.
#include "sim/columns/estimate_text.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace sim {
namespace {

TEST(EstimateText, HasTheDigitsThatTheIntervalSupports) {
  EXPECT_EQ(estimate_text({0.02361, 0.02312, 0.02409}), "0.0236 [0.0231, 0.0241]");
  EXPECT_EQ(estimate_text({0.0236, 0.011, 0.05}), "0.024 [0.011, 0.050]");
  EXPECT_EQ(estimate_text({1.234e-4, 1e-4, 2e-4}), "1.2e-4 [1.0e-4, 2.0e-4]");
  EXPECT_EQ(estimate_text({0, 0, 0.018}), "< 1.8e-2");
  EXPECT_EQ(estimate_text({std::numeric_limits<double>::quiet_NaN(), 0, 1}), "-");
}

TEST(EstimateText, RoundsTheEndsOutwards) {
  EXPECT_EQ(estimate_text({0.02361, 0.02319, 0.02401}), "0.0236 [0.0231, 0.0241]");
  EXPECT_EQ(estimate_text({1.234e-4, 1.09e-4, 1.91e-4}), "1.2e-4 [1.0e-4, 2.0e-4]");
  EXPECT_EQ(estimate_text({0, 0, 0.01811}), "< 1.9e-2");
  EXPECT_EQ(estimate_text({0, 0, 1.82}), "< 1.9");
}

TEST(EstimateText, TellsTheEndsFromTheValue) {
  EXPECT_EQ(estimate_text({1, 0.9982, 1}), "1.000 [0.998, 1.000]");
  EXPECT_EQ(estimate_text({1, 0.99988, 1}), "1.0000 [0.9998, 1.0000]");
  EXPECT_EQ(estimate_text({0.5123, 0.51225, 0.51235}), "0.51230 [0.51225, 0.51235]");
  EXPECT_EQ(estimate_text({2e-3, 1.999e-3, 2.001e-3}), "2.00e-3 [1.99e-3, 2.01e-3]")
      << "the column is no wider";
  EXPECT_EQ(estimate_text({1, 1, 1}), "1.00 [1.00, 1.00]") << "known without doubt";
}

}  // namespace
}  // namespace sim
