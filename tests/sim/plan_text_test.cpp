// Plans of light as texts: read as written, and refused in one line where they are none.
#include "sim/fit/plan_text.hpp"

#include <gtest/gtest.h>

#include <string>

#include "sim/failure.hpp"

namespace sim {
namespace {

Plan plan_in(const std::string& text) { return plan_of_text(text, "p.txt"); }

std::string plan_refusal(const std::string& text) {
  try {
    plan_in(text);
  } catch (const Failure& e) {
    EXPECT_EQ(e.code(), ExitCode::bad_input);
    return e.what();
  }
  return "taken";
}

const std::string say_how = "write start_ms carrier_hz cycles_on cycles_off repeats level_db";
const std::string look = "look for a wrong unit or column";

TEST(PlanText, IsReadAsItWasWritten) {
  const Plan plan{{{0.0625, 16e6 / 286, 30, 530, 5, 0},
                   {150, 16e6 / 317, 67200, 0, 1, -35.8},
                   {2000.1234375, 38e3, 1, 999999, 3, 12.5}}};
  EXPECT_EQ(plan_in(plan_text(plan, {})), plan);
  EXPECT_EQ(plan_in(plan_text(plan, {"a remark, 1 2 3", ""})), plan);
}

TEST(PlanText, MayBeWrittenAsPeopleWriteTables) {
  const Plan plan{{{100, 56000, 30, 530, 5, 0}, {200, 56000, 67200, 0, 1, -8}}};
  EXPECT_EQ(plan_in("100 56000 30 530 5 0\n200 56000 67200 0 1 -8"), plan) << "no last line end";
  EXPECT_EQ(plan_in("100,56000,30,530,5,0\n200,56000,67200,0,1,-8\n"), plan);
  EXPECT_EQ(plan_in("100, 56e3,\t30 530 5.0  0 # mark\n\n  # all\n200\t56000 67200 0 1 -8\n"),
            plan);
  EXPECT_EQ(plan_in("\xEF\xBB\xBF"
                    "100 56000 30 530 5 0\r\n\r\n200 56000 67200 0 1 -8\r\n"),
            plan)
      << "as Windows writes it";
}

TEST(PlanText, LevelsAreRelativeToTheFirst) {
  const Plan plan = plan_in("0 56000 30 530 1 -10\n200 56000 30 530 1 -18.5\n");
  EXPECT_EQ(plan.steps[0].level_db, 0);
  EXPECT_EQ(plan.steps[1].level_db, -8.5);
}

TEST(PlanText, AStepEndsBehindItsLastGap) {
  EXPECT_EQ(end_ms({100, 50e3, 30, 470, 4, 0}), 140);
  EXPECT_EQ(plan_in("0 50000 30 470 4 0\n40 50000 1 0 1 0").steps.size(), 2U) << "they may touch";
  EXPECT_EQ(plan_in("0 50000 30 471 4 0\n40.079 50000 1 0 1 0").steps.size(), 2U) << "rounded";
}

TEST(PlanText, RefusesWhatHasNoStep) {
  for (const char* text : {"", "\n\n", "# 1 2 3 4 5 6\n", "\xEF\xBB\xBF"})
    EXPECT_EQ(plan_refusal(text), "p.txt (a plan without a step) " + say_how);
  EXPECT_EQ(plan_refusal("\xFF\xFE"
                         "0\0"),
            "cannot decode p.txt (it is UTF-16 text) save it as UTF-8");
}

TEST(PlanText, RefusesOtherThanSixFields) {
  EXPECT_EQ(plan_refusal("# \n0 56000 30 530 5\n"),
            "a step of 5 fields in p.txt:2 (it has six) " + say_how);
  EXPECT_EQ(plan_refusal("0 56000 30 530 5 0 0\n"),
            "a step of 7 fields in p.txt:1 (it has six) " + say_how);
  EXPECT_EQ(plan_refusal("0,56000,,530,5,0\n"),
            "cycles_on =  in p.txt:1 (not a number) " + say_how);
}

TEST(PlanText, RefusesNumbersThatNoPlanHas) {
  const auto with = [](const std::string& one, const std::string& other) {
    return plan_refusal("0 56000 30 530 5 0\n" + one + " 56000 " + other + "\n");
  };
  const std::string at = " in p.txt:2 (";
  EXPECT_EQ(with("x", "30 530 5 0"), "start_ms = x" + at + "not a number) " + say_how);
  EXPECT_EQ(with("-1", "30 530 5 0"),
            "start_ms = -1" + at + "a plan begins at 0 and ends within a day) " + look);
  for (const char* huge : {"nan", "inf", "-inf", "1e300"})
    EXPECT_EQ(with(huge, "30 530 5 0"), std::string("start_ms = ") + huge + at +
                                            "a plan begins at 0 and ends within a day) " + look);
  EXPECT_EQ(with("900", "0 530 5 0"),
            "cycles_on = 0" + at + "a burst has 1 to 1e9 cycles) " + look);
  EXPECT_EQ(with("900", "30.5 530 5 0"),
            "cycles_on = 30.5" + at + "not a whole number) write one without a fraction");
  EXPECT_EQ(with("900", "30 -1 5 0"),
            "cycles_off = -1" + at + "a gap has 0 to 1e9 cycles) " + look);
  EXPECT_EQ(with("900", "30 530 0 0"), "repeats = 0" + at + "a step has 1 to 1e9 bursts) " + look);
  EXPECT_EQ(with("900", "30 530 5 -201"),
            "level_db = -201" + at + "a level is -200 to 200 dB) " + look);
  EXPECT_EQ(with("900", "30 530 5 nan"),
            "level_db = nan" + at + "a level is -200 to 200 dB) " + look);
  EXPECT_EQ(plan_refusal("0 56 30 530 5 0"),
            "carrier_hz = 56 in p.txt:1 (a carrier is 1e3 to 1e7 Hz) " + look);
  EXPECT_EQ(plan_refusal("0 56000 1e9 1e9 1e9 0"),
            "a step that ends at 3.57143e+16 ms in p.txt:1 (a plan begins at 0 and ends within a "
            "day) look at its cycles and repeats");
}

TEST(PlanText, RefusesBurstsThatAreOne) {
  EXPECT_EQ(plan_refusal("0 56000 30 0 5 0"),
            "repeats = 5 in p.txt:1 (bursts without dark between them are one) give the gap as "
            "cycles_off");
}

TEST(PlanText, RefusesStepsThatOverlap) {
  EXPECT_EQ(plan_refusal("0 50000 30 470 4 0\n# \n39 50000 1 0 1 0"),
            "start_ms = 39 in p.txt:3 (that of line 1 lasts until 40.000 ms) let it begin then or "
            "later");
  EXPECT_EQ(plan_refusal("100 50000 30 470 4 0\n39 50000 1 0 1 0"),
            "start_ms = 39 in p.txt:2 (that of line 1 begins later) put steps in order of time");
}

TEST(PlanText, ShowsWhatItCannotReadInOneLine) {
  const std::string why = plan_refusal(std::string("\x1b[2J\0 1 1 1 1 1", 15));
  EXPECT_EQ(why.find_first_of("\x1b\n"), std::string::npos) << why;
  EXPECT_NE(why.find("in p.txt:1 (not a number)"), std::string::npos) << why;
}

}  // namespace
}  // namespace sim
