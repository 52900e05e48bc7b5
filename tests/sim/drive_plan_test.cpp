// Plans out of captures: what was on the LED's wire, be it pulses or a level, is the plan that was
// played but for its levels.
#include "sim/fit/drive_plan.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "capture_lines.hpp"
#include "played_plan.hpp"

namespace sim {
namespace {

class DrivePlan : public testing::Test {
 protected:
  ~DrivePlan() override { std::filesystem::remove(path_); }

  Plan plan_on(const RecordedWire& wire, double carrier_hz = 56e3) const {
    std::ofstream(path_, std::ios::binary) << capture_of({wire, {"other", true, {0.05}}});
    return plan_of_drive(path_, {wire.name, {}, {}}, carrier_hz, [](dsp::Seconds) {});
  }

  std::filesystem::path path_ = std::filesystem::temp_directory_path() /
                                ("cosys-drive-test-" + std::to_string(::getpid()) + ".csv");
};

void expect_bursts_of(const Plan& read, const Plan& played, double tolerance_cycles) {
  struct Burst {
    double begin_s, end_s, carrier_hz;
  };
  const auto bursts_of = [](const Plan& plan) {
    std::vector<Burst> bursts;
    for_each_burst(plan, [&](double begin_s, double end_s, const PlanStep& step) {
      bursts.push_back({begin_s, end_s, step.carrier_hz});
    });
    return bursts;
  };
  const std::vector<Burst> a = bursts_of(read), b = bursts_of(played);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_NEAR(a[i].begin_s * b[i].carrier_hz, b[i].begin_s * b[i].carrier_hz, tolerance_cycles);
    EXPECT_NEAR(a[i].end_s * b[i].carrier_hz, b[i].end_s * b[i].carrier_hz, tolerance_cycles);
  }
}

const Plan played_plan{{{10, 56000, 30, 530, 5, 0},
                        {110, 50900, 30, 480, 6, -20},
                        {300, 61600, 1, 99, 3, -20},
                        {400, 56000, 6000, 0, 1, -8},
                        {508, 56000, 20, 176, 40, -16}}};

TEST_F(DrivePlan, IsThePlanWhosePulsesTheWireHas) {
  const Plan plan = plan_on({"D10", false, changes_of_carrier(played_plan)});
  expect_bursts_of(plan, played_plan, 1.01);
  ASSERT_LE(plan.steps.size(), 6U) << "what comes evenly is one step";
  EXPECT_EQ(plan.steps[0].cycles_on, 30U);
  EXPECT_EQ(plan.steps[0].cycles_off, 530U);
  EXPECT_EQ(plan.steps[0].repeats, 5U);
  EXPECT_NEAR(plan.steps[1].carrier_hz, 50900, 1);
  for (const PlanStep& step : plan.steps) EXPECT_EQ(step.level_db, 0);
}

TEST_F(DrivePlan, IsThePlanWhoseLightALevelHas) {
  const WireChanges mark = changes_of_mark(played_plan);
  for (const bool idle : {false, true}) {
    const Plan plan = plan_on({"D7", idle, mark});
    expect_bursts_of(plan, played_plan, 1.5);
    for (const PlanStep& step : plan.steps) EXPECT_EQ(step.carrier_hz, 56000);
  }
  EXPECT_EQ(plan_on({"D7", false, mark}, 38e3).steps[0].cycles_on, 20U) << "30 cycles of 56 kHz";
}

TEST_F(DrivePlan, CanBeReadWhereItIsWritten) {
  for (const WireChanges& changes :
       {changes_of_carrier(played_plan), changes_of_mark(played_plan)}) {
    const Plan plan = plan_on({"D", false, changes});
    EXPECT_EQ(plan_of_text(plan_text(plan, {}), "p.txt"), plan) << "no step overlaps the next";
  }
}

TEST(PlanOfBursts, GivesABurstAwayThatTheNextStepIsTooNearTo) {
  const Plan plan = plan_of_bursts(
      {{0.00, 50e3, 10}, {0.01, 50e3, 10}, {0.02, 50e3, 10}, {0.021, 50e3, 40}, {0.1, 50e3, 10}});
  const Plan wanted{{{0, 50e3, 10, 490, 2, 0},
                     {20, 50e3, 10, 0, 1, 0},
                     {21, 50e3, 40, 0, 1, 0},
                     {100, 50e3, 10, 0, 1, 0}}};
  EXPECT_EQ(plan, wanted);
}

TEST_F(DrivePlan, RefusesAWireOfNoLight) {
  EXPECT_EQ(test::failure_of([&] {
              plan_on({"D7", false, {}});
            }),
            "D7 of " + path_.string() +
                " (it never changes: no light is on it) say --drive, or --plan PLAN");
}

}  // namespace
}  // namespace sim
