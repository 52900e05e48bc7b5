// Importance sampling against what is known otherwise: the closed forms of the matched receivers
// and, where errors can still be counted, trials as they come. Long measurements; the parts are in
// importance_test.cpp.
#include <cmath>
#include <string>
#include <vector>

#include "gtest/gtest.h"
#include "scenarios.hpp"
#include "sim/counting/statistics.hpp"
#include "sim/link_experiment/link_measurement.hpp"

namespace sim {
namespace {

/// A point whose trials need no more before them than a line that may have lost its end.
LinkPoint point(std::vector<std::string> set, const std::string& method, std::uint64_t frames) {
  set.insert(set.end(), {"simulation.method=" + method, "simulation.warmup_messages=1"});
  const Link link = link_of(set);
  return run_point(link, {.max_frames = frames}, {.threads = threads_for(0)});
}

std::vector<std::string> set_of(const std::string& module, const std::string& ebn0_db) {
  return {"receiver.module=" + module, "receiver.ebn0_db=" + ebn0_db};
}

struct Closed {
  const char* module;
  const char* ebn0_db;
  double ber;  // about; 1e-6, 1e-9 and 1e-12 for each receiver
};

class RareEventsInTheory : public testing::TestWithParam<Closed> {};

TEST_P(RareEventsInTheory, MeasuredBitErrorRatio) {
  const Closed at = GetParam();
  const LinkPoint measured = point(set_of(at.module, at.ebn0_db), "importance", 640);
  const double theory = measured.operating.ber_theory;
  EXPECT_NEAR(std::log10(theory), std::log10(at.ber), 0.3) << theory;
  EXPECT_NEAR(bit_error_ratio(measured.tally, 0.95).value / measured.operating.ber_sampled, 1, 0.2);
  const double variation = measured.tally.weighted.bit_errors.coefficient_of_variation(80);
  EXPECT_LT(variation * std::sqrt(640), 0.05 * std::sqrt(1600));
}

INSTANTIATE_TEST_SUITE_P(, RareEventsInTheory,
                         testing::Values(Closed{"ideal-coherent", "13.5", 1e-6},
                                         Closed{"ideal-coherent", "15.5", 1e-9},
                                         Closed{"ideal-coherent", "16.9", 1e-12},
                                         Closed{"ideal-noncoherent", "14", 1e-6},
                                         Closed{"ideal-noncoherent", "15.9", 1e-9},
                                         Closed{"ideal-noncoherent", "17.2", 1e-12}),
                         [](const auto& test) {
                           const std::string name = test.param.module;
                           return name.substr(name.find('-') + 1) + std::to_string(test.index % 3);
                         });

struct Counted {
  const char* module;
  const char* ebn0_db;
  std::uint64_t frames, of_importance;
};

class RareEventsAsCounted : public testing::TestWithParam<Counted> {};

/// Whether two ratios agree at 99 %: their logarithms are about normal.
void expect_agreement(const Estimate& a, const Estimate& b) {
  ASSERT_GT(a.low, 0);
  ASSERT_GT(b.low, 0);
  const double apart = std::log(a.value / b.value);
  const double half = std::hypot(std::log(a.high / a.low), std::log(b.high / b.low)) / 2;
  EXPECT_LT(std::abs(apart), half) << a.value << " and " << b.value;
}

void expect_agreement(const std::vector<std::string>& set, std::uint64_t frames,
                      std::uint64_t of_importance) {
  const Tally drawn = point(set, "importance", of_importance).tally;
  const Tally counted = point(set, "brute-force", frames).tally;
  expect_agreement(bit_error_ratio(drawn, 0.99), bit_error_ratio(counted, 0.99));
  expect_agreement(frame_loss_ratio(drawn, 0.99), frame_loss_ratio(counted, 0.99));
}

TEST_P(RareEventsAsCounted, MeasuredBitErrorsAndLosses) {
  const Counted at = GetParam();
  expect_agreement(set_of(at.module, at.ebn0_db), at.frames, at.of_importance);
}

// Some units hear everything, some nothing, so those near the edge are run most.
TEST(RareEvents, MeasuredOfUnitsThatDiffer) {
  std::vector<std::string> set = set_of("TSSP4056", "37.5");
  set.emplace_back("receiver.population=true");
  expect_agreement(set, 4000, 1600);
}

// Bit error ratios of about 1e-3, then 1e-4.
INSTANTIATE_TEST_SUITE_P(, RareEventsAsCounted,
                         testing::Values(Counted{"TSSP4056", "35.2", 1000, 800},
                                         Counted{"TSSP4056", "35.33", 4000, 1600},
                                         Counted{"TSOP4156", "48.2", 1000, 800},
                                         Counted{"TSOP4156", "48.28", 4000, 1600},
                                         Counted{"TSSP96056", "37.75", 1000, 800},
                                         Counted{"TSSP96056", "37.87", 4000, 1600}),
                         [](const auto& test) {
                           return std::string(test.param.module) +
                                  (test.index % 2 == 0 ? "at1em3" : "at1em4");
                         });

}  // namespace
}  // namespace sim
