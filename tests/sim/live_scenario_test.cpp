// Changes of a scenario while its line runs: the point is then that of --set, or as it was.
#include "sim/serve/live_scenario.hpp"
#include "scenarios.hpp"

namespace sim {
namespace {

const std::string one_metre = "[receiver]\nrange_m = 1\n";

LiveScenario live(const std::string& toml, const std::vector<std::string>& set = {}) {
  return LiveScenario({toml, "x.toml", set, {COSYS_SOURCE_DIR "/scenarios"}});
}

std::string live_refusal(const std::string& toml, const std::vector<std::string>& set = {}) {
  try {
    live(toml, set);
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::bad_input);
    return failure.what();
  }
  return "accepted";
}

std::uint32_t number_of_point(const std::vector<std::string>& set) {
  return make_link(point_scenario(loaded(one_metre, set), {})).point;
}

TEST(LiveScenario, IsThePointThatSetMakes) {
  LiveScenario scenario = live(one_metre, {"led.current_ma=50"});
  EXPECT_EQ(scenario.link()->point, number_of_point({"led.current_ma=50"}));
  scenario.set("receiver.range_m=4");
  EXPECT_EQ(scenario.link()->point, number_of_point({"led.current_ma=50", "receiver.range_m=4"}));
  scenario.set("ambient.irradiance_w_per_m2=2");
  scenario.set("receiver.range_m=1");
  EXPECT_EQ(scenario.link()->point,
            number_of_point({"led.current_ma=50", "ambient.irradiance_w_per_m2=2"}));
  scenario.set("led.current_ma=100");
  scenario.set("ambient.irradiance_w_per_m2=0.6");
  EXPECT_EQ(scenario.link()->point, number_of_point({}));
  scenario.set("receiver.module=TSOP4456");
  scenario.set("device.message=IND 1 OK");
  EXPECT_EQ(scenario.link()->point,
            number_of_point({"receiver.module=TSOP4456", "device.message=IND 1 OK"}));
  EXPECT_EQ(scenario.link()->message, "IND 1 OK");
}

TEST(LiveScenario, IsAsItWasBehindAChangeThatIsRefused) {
  LiveScenario scenario = live(one_metre);
  scenario.set("receiver.range_m=2");
  const auto before = scenario.link();
  for (const char* wrong :
       {"receiver.range_m=-1", "receiver.range_m=x", "receiver.rage_m=1", "receiver.range_m",
        "receiver.range_m=1,2", "receiver.module=none", "device.interval_min_ms=1000",
        "simulation.seed=2", "stop.max_frames=3", "experiment=arena", "arena.height_mm=3", "=", "x",
        "receiver.range_m=3 ambient.irradiance_w_per_m2=2"}) {
    EXPECT_THROW(scenario.set(wrong), Failure) << wrong;
    EXPECT_EQ(scenario.link(), before) << wrong;
  }
  scenario.set("led.current_ma=50");  // and none of them is kept
  EXPECT_EQ(scenario.link()->point, number_of_point({"receiver.range_m=2", "led.current_ma=50"}));
}

TEST(LiveScenario, RefusesWhatIsNoLine) {
  EXPECT_EQ(live_refusal("[sweep]\nreceiver.range_m = [1, 2]\n"),
            "receiver.range_m has several values in x.toml:2 (a line is at one point) give one, "
            "such as receiver.range_m=1");
  EXPECT_EQ(live_refusal("", {"receiver.module=TSOP4456,TSOP4856"}),
            "receiver.module has several values in --set (a line is at one point) give one, such "
            "as receiver.module=TSOP4456");
  EXPECT_EQ(live_refusal("[simulation]\nwarmup_messages = 0\n"),
            "simulation.warmup_messages = 0 in x.toml:2 (a trial of one message has no pause that "
            "could be played) use at least 1");
  EXPECT_NE(live_refusal("", {"simulation.method=importance"}), "accepted");
  EXPECT_EQ(live_refusal("[sweep]\nreceiver.range_m = [1]\n"), "accepted");
}

}  // namespace
}  // namespace sim
