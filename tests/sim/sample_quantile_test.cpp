// Quantiles of a sample: type 7 of Hyndman & Fan.
#include "sim/counting/sample_quantile.hpp"

#include <cmath>
#include <vector>

#include "gtest/gtest.h"

namespace sim {
namespace {

// As R's quantile(c(7, 1, 2, 4), c(0, .1, .25, .5, .75, .9, 1)) has them, which is of type 7.
TEST(SampleQuantile, IsThatOfTypeSeven) {
  const std::vector<double> sample{7, 1, 2, 4};
  const double shares[] = {0, .1, .25, .5, .75, .9, 1};
  const double quantiles[] = {1, 1.3, 1.75, 3, 4.75, 6.1, 7};
  for (std::size_t i = 0; i < std::size(shares); ++i)
    EXPECT_NEAR(sample_quantile(sample, shares[i]), quantiles[i], 1e-12) << shares[i];
}

TEST(SampleQuantile, IsAValueOfTheSampleWhereOneStandsThere) {
  EXPECT_EQ(sample_quantile({3, 1, 2}, 0.5), 2);
  EXPECT_EQ(sample_quantile({5}, 0.9), 5);
  EXPECT_EQ(sample_quantile({0.1, 0.1, 0.1, 0.1}, 0.3), 0.1);
}

// A sample and its mirror image have mirrored quantiles.
TEST(SampleQuantile, TreatsBothEndsAlike) {
  const std::vector<double> sample{0, 1, 5, 6, 20}, mirrored{0, -1, -5, -6, -20};
  for (const double share : {0., .1, .33, .5, .8413})
    EXPECT_NEAR(sample_quantile(sample, share), -sample_quantile(mirrored, 1 - share), 1e-12);
}

TEST(SampleQuantile, OfNothingIsUnknown) { EXPECT_TRUE(std::isnan(sample_quantile({}, 0.5))); }

}  // namespace
}  // namespace sim
