// What a report says of detectors: where they notice the device, and how they differ in that.
#include <gtest/gtest.h>

#include "sim/loading/load_scenario.hpp"
#include "sim/location/location_parts.hpp"

namespace sim {
namespace {

/// Two detectors at four ranges, and how often each noticed the device.
std::string answer(const std::vector<double>& p_detection) {
  StoredDataset stored{
      parse_scenario(
          "experiment = \"presence\"\n[presence]\ntrials = 20\n[sweep]\n"
          "presence.detector = [\"goertzel\", \"synchronous\"]\nreceiver.range_m = [1, 2, 3, 4]\n",
          "x.toml", {}, {COSYS_SOURCE_DIR "/scenarios"}),
      {}};
  stored.data = dataset_of(stored.scenario, "c");
  stored.data.dimensions = {{{"false_alarm", "1", "as set"}, std::vector<double>{0.001}}};
  stored.data.variables = {{{"n_trials", "1", ""}, true, {}, std::vector<std::int64_t>(8, 20)},
                           {{"p_detection", "1", ""}, true, {"false_alarm"}, p_detection}};
  return presence_part("p", stored).verdict;
}

void expect_has(const std::string& answer, const std::string& text) {
  EXPECT_NE(answer.find(text), std::string::npos) << answer;
}

TEST(PresencePart, NamesNoDetectorWhereAllNoticeTheDeviceAtTheSamePoints) {
  expect_has(answer({0, 1, 0.9, 0, 0, 0.95, 1, 0.89}), "at receiver.range_m [m] from 2 to 3.\n");
}

TEST(PresencePart, SaysWhereEachNoticesItThoughTheirStretchesAreEquallyLong) {
  expect_has(
      answer({0, 0, 1, 1, 1, 1, 0, 0}),
      "from 1 to 2 (presence.detector = synchronous), but at receiver.range_m [m] from 3 to 4 "
      "(presence.detector = goertzel).\n");
}

TEST(PresencePart, SaysWhichNoticesItAtFewerPoints) {
  expect_has(answer({1, 1, 1, 0, 1, 0, 0, 0}),
             "from 1 to 3 (presence.detector = goertzel), but only at receiver.range_m [m] 1 "
             "(presence.detector = synchronous).\n");
}

TEST(PresencePart, SaysHowManyNoticeItNowhere) {
  expect_has(answer({1, 1, 1, 0, 0, 0, 0, 0}),
             "from 1 to 3 (presence.detector = goertzel), but nowhere by 1 of 2.\n");
  expect_has(answer(std::vector<double>(8, 0.5)), "at no point that was measured is the device");
}

}  // namespace
}  // namespace sim
