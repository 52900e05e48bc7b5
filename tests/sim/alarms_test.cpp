// Counts that should not be trusted are called so, and ordinary ones are not.
#include "sim/result/alarms.hpp"

#include "program.hpp"
#include "scenarios.hpp"
#include "sim/link_experiment/link_measurement.hpp"
#include "sim/scenario/flags.hpp"
#include "sim/text/text_file.hpp"

namespace sim {
namespace {

/// Frames of 170 bits, each with so many wrong.
LinkPoint point_of_errors(std::uint64_t frames, std::uint64_t wrong_bits_each) {
  LinkPoint p;
  p.tally.n_frames = frames;
  p.tally.n_bits = frames * 170;
  p.tally.n_bit_errors = frames * wrong_bits_each;
  p.tally.n_frames_bit_errors = wrong_bits_each > 0 ? frames : 0;
  p.tally.sum_bits_squared = frames * 170 * 170;
  p.tally.sum_bit_errors_squared = frames * wrong_bits_each * wrong_bits_each;
  p.tally.sum_bit_errors_times_bits = frames * wrong_bits_each * 170;
  p.operating.ebn0_db = 10;
  return p;
}

std::string names_of(const LinkPoint& point) { return raised_names(alarms(), own_alarms(point)); }

TEST(Alarms, AreRaisedByAPointItself) {
  EXPECT_EQ(names_of(point_of_errors(100, 17)), "");
  EXPECT_EQ(names_of(point_of_errors(100, 85)), "");
  EXPECT_EQ(names_of(point_of_errors(100, 106)), "half");
  EXPECT_EQ(names_of({}), "");  // nothing counted
}

TEST(Alarms, TheoryIsThatOfTheReceiver) {
  LinkPoint p = point_of_errors(100, 17);
  p.operating.ber_theory = 0.1;
  EXPECT_EQ(names_of(p), "");
  p.operating.ber_theory = 0.12;
  EXPECT_EQ(names_of(p), "theory");
  p.operating.ber_sampled = 0.1;
  EXPECT_EQ(names_of(p), "");
  std::swap(p.operating.ber_theory, p.operating.ber_sampled);
  EXPECT_EQ(names_of(p), "theory");
}

// Q(sqrt(2)) = 0.079 at 0 dB with 3 dB to spare: of 200 frames without an error there are too many.
TEST(Alarms, NoErrorsWhereTheoryExpectsMany) {
  LinkPoint p = point_of_errors(200, 0);
  p.operating.ebn0_db = 0;
  EXPECT_EQ(names_of(p), "impossible");
  p.tally.n_frames = 20;  // which may be luck
  EXPECT_EQ(names_of(p), "");
  p = point_of_errors(200, 0);
  p.operating.ebn0_db = 12;  // 9e-9
  EXPECT_EQ(names_of(p), "");
  p = point_of_errors(200, 60);  // a pin that stands still, of a message with few zeros
  p.operating.ebn0_db = -30;
  EXPECT_EQ(names_of(p), "");
}

// Matched receivers do what theory says, so nothing is to be distrusted.
TEST(Alarms, MatchedReceiversRaiseNone) {
  for (const char* receiver : {"ideal-coherent", "ideal-noncoherent"}) {
    for (const char* ebn0 : {"0", "6"}) {
      const Link link = link_of(
          {std::string("receiver.module=") + receiver, std::string("receiver.ebn0_db=") + ebn0,
           "simulation.sample_rate_hz=250000", "simulation.warmup_messages=0"});
      const LinkPoint p = run_point(link, {.max_frames = 80}, {.threads = 2});
      EXPECT_EQ(names_of(p), "") << receiver << ebn0;
    }
  }
}

LinkResult row_of(const std::vector<std::uint64_t>& lost) {
  LinkResult result;
  result.axes = {{"receiver.range_m", "m", "", {}, {}}};
  for (const std::uint64_t n : lost) {
    result.axes[0].values.push_back(static_cast<double>(result.points.size() + 1));
    result.points.push_back({.coordinates = {result.axes[0].values.back()}});
    result.points.back().tally.n_frames = 1000;
    result.points.back().tally.n_frames_lost = n;
  }
  add_row_alarms(result);
  return result;
}

TEST(Alarms, ACurveThatGoesUpAndDownIsOne) {
  for (const LinkPoint& p : row_of({0, 500, 0}).points)
    EXPECT_EQ(raised_names(alarms(), p.alarms), "monotone");
  for (const LinkPoint& p : row_of({0, 20, 15, 500}).points) EXPECT_EQ(p.alarms, 0u);
}

TEST(Alarms, TheDocsListEveryAlarm) {
  const std::string docs = read_text_file(COSYS_SOURCE_DIR "/scenarios/README.md", "docs");
  for (const Alarm& alarm : alarms())
    EXPECT_NE(docs.find("`" + std::string(alarm.name) + "`"), std::string::npos) << alarm.name;
}

TEST_F(CommandLine, AlarmsArePrintedAndStored) {
  write_scenario("s.toml", "receiver.range_m = [1, 30]");
  const Outcome o = program({"run", "s.toml", "-q"});
  EXPECT_NE(o.out.find("max_frames  !! half\n!! half: bit error ratio above 0.5: silence reads as "
                       "ones, so the link is dead\n"),
            std::string::npos)
      << o.out;
  EXPECT_EQ(values("s.h5", "alarms"), "0, 1");
  const Outcome json = program({"run", "s.toml", "-q", "--json"});
  EXPECT_NE(json.out.find("\"alarm_names\": [\n        \"half\"\n      ]"), std::string::npos);
}

}  // namespace
}  // namespace sim
