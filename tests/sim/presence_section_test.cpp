// What a report says of detectors: where they notice the device, and how they differ in that.
#include <gtest/gtest.h>

#include "sim/loading/load_scenario.hpp"
#include "sim/location/location_sections.hpp"

namespace sim {
namespace {

/// How often the points of a sweep noticed the device.
std::string answer(const std::vector<double>& p_detection, const std::string& sweep) {
  StoredDataset stored{
      parse_scenario("experiment = \"presence\"\n[presence]\ntrials = 20\n[sweep]\n" + sweep,
                     "x.toml", {}, {COSYS_SOURCE_DIR "/scenarios"}),
      {}};
  stored.data = dataset_of(stored.scenario, "c");
  stored.data.dimensions = {{{"false_alarm", "1", "as set"}, std::vector<double>{0.001}}};
  stored.data.variables = {
      {{"n_trials", "1", ""}, true, {}, std::vector<std::int64_t>(p_detection.size(), 20)},
      {{"p_detection", "1", ""}, true, {"false_alarm"}, p_detection}};
  return presence_section("p", stored).summary;
}

/// Two detectors at four ranges.
std::string answer(const std::vector<double>& p_detection) {
  return answer(p_detection,
                "presence.detector = [\"goertzel\", \"synchronous\"]\n"
                "receiver.range_m = [1, 2, 3, 4]\n");
}

void expect_answer_has(const std::string& answer, const std::string& text) {
  EXPECT_NE(answer.find(text), std::string::npos) << answer;
}

TEST(PresenceSection, NamesNoDetectorWhereAllNoticeTheDeviceAtTheSamePoints) {
  expect_answer_has(answer({0, 1, 0.9, 0, 0, 0.95, 1, 0.89}),
                    "at receiver.range_m from 2 to 3 m, in both cases.\n");
}

TEST(PresenceSection, SaysWhereEachNoticesItThoughTheirStretchesAreEquallyLong) {
  expect_answer_has(answer({0, 0, 1, 1, 1, 1, 0, 0}),
                    "from 3 to 4 m, where the sweep ends (goertzel), but at "
                    "receiver.range_m from 1, where the sweep begins, to 2 m ("
                    "synchronous).\n");
  expect_answer_has(
      answer(std::vector<double>(8, 1)),
      "from 1, where the sweep begins, to 4 m, where the sweep ends, in both cases.\n");
}

TEST(PresenceSection, NamesTheOneOfThreeThatNoticesItElsewhere) {
  expect_answer_has(answer({1, 1, 0, 0, 0, 0, 1, 1, 1, 1, 0, 0},
                           "presence.detector = \"*\"\nreceiver.range_m = [1, 2, 3, 4]\n"),
                    ", but at receiver.range_m from 3 to 4 m, where the sweep ends (");
}

TEST(PresenceSection, SaysOfDetectorsThatNoticeItAsOftenThatTheyDo) {
  const std::string detectors = "presence.detector = [\"goertzel\", \"synchronous\"]\n";
  expect_answer_has(answer({0.75, 0.75}, detectors),
                    "the device is noticed in 0.75 of the windows at each of 2 points.\n");
  expect_answer_has(
      answer({0.75, 0.5}, detectors),
      "noticed least at presence.detector = synchronous: in 0.5 of the windows, and most ");
}

TEST(PresenceSection, SaysWhichNoticesItAtFewerPoints) {
  expect_answer_has(answer({1, 1, 1, 0, 1, 0, 0, 0}),
                    "from 1, where the sweep begins, to 3 m (goertzel), but only at "
                    "receiver.range_m = 1 m, where the sweep begins (synchronous).\n");
}

TEST(PresenceSection, SaysHowManyNoticeItNowhere) {
  expect_answer_has(answer({1, 1, 1, 0, 0, 0, 0, 0}),
                    "from 1, where the sweep begins, to 3 m (goertzel), but nowhere in 1 "
                    "of 2 cases.\n");
  expect_answer_has(answer(std::vector<double>(8, 0.5)),
                    "at no point that was simulated is the device");
}

}  // namespace
}  // namespace sim
