#pragma once
// What was measured on a link against the theory of its bit error ratio.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "sim/counting/statistics.hpp"
#include "sim/link/link.hpp"

namespace sim {

/// Of so many decibels of power.
inline double ratio_of(double db) { return std::pow(10, db / 10); }

/// Whether a 99.9 % interval around what was measured holds the theory: errors are independent.
inline void expect_ber(const Link& link, const Tally& tally, double theory,
                       const std::string& what) {
  const auto [low, high] = clopper_pearson(static_cast<double>(tally.n_bit_errors),
                                           static_cast<double>(tally.n_bits), 0.999);
  EXPECT_LE(low, theory) << what << ": " << tally.n_bit_errors << " of " << tally.n_bits;
  EXPECT_GE(high, theory) << what << ": " << tally.n_bit_errors << " of " << tally.n_bits;
  EXPECT_NEAR(link.operating.ber_theory / theory, 1, 1e-4) << what;
}

}  // namespace sim
