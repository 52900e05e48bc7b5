// What an arena's scenario must not say, and the line that says so.
#include "arena_scenes.hpp"
#include "gtest/gtest.h"
#include "sim/scenario/experiment_kind.hpp"
#include "sim/scenario/keys.hpp"

namespace sim {
namespace {

std::string line_of(const std::string& text, const std::vector<std::string>& set = {}) {
  try {
    check_experiment(loaded(text, set));
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::bad_input);
    std::string line = failure.what();
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    EXPECT_LT(line.size(), 300u) << line;
    return line;
  }
  return "accepted";
}

const std::string one = "experiment = \"arena\"\n[devices.a]\nx_m = 1\n";

std::string line_with(const std::string& line) { return line_of(one + line + "\n"); }

TEST(ArenaRefusals, OneDeviceIsEnough) { EXPECT_EQ(line_of(one), "accepted"); }

TEST(ArenaRefusals, NoDeviceAtAll) {
  EXPECT_EQ(line_of("experiment = \"arena\"\n"),
            "x.toml (an arena without a device) add a table [devices.NAME] with its place");
  EXPECT_EQ(line_of("experiment = \"arena\"\n[devices]\n"),
            "x.toml (an arena without a device) add a table [devices.NAME] with its place");
}

// A typo would be one device more.
TEST(ArenaRefusals, DevicesOfWhichNobodySaysWhereTheyAre) {
  const std::string charger = "experiment = \"arena\"\n[devices.charger]\nx_m = 1\n";
  const std::string line =
      "devices.chrger (this device has no place) did you mean devices.charger?";
  EXPECT_EQ(line_of(charger, {"devices.chrger.count=2"}), line);
  EXPECT_EQ(line_of(charger, {"devices.chrger.count=1,2"}), line);
  EXPECT_EQ(line_of(charger + "[sweep]\ndevices.chrger.count = [1, 2]\n"), line);
  EXPECT_EQ(line_of(charger, {"devices.charger.count=1,2"}), "accepted");
  EXPECT_EQ(line_of(charger, {"devices.charger.x_m=1,2"}), "accepted");
  EXPECT_EQ(line_of("experiment = \"arena\"\n[devices.a]\ncount = 2\n"),
            "devices.a (this device has no place) give devices.a.x_m and y_m");
}

TEST(ArenaRefusals, ADeviceWithoutANameOrPlace) {
  EXPECT_EQ(line_of("experiment = \"arena\"\n[devices]\nx_m = 1\n"),
            "devices.x_m in x.toml:3 (a device has a name) write [devices.NAME], such as "
            "[devices.charger]");
  EXPECT_EQ(line_of("experiment = \"arena\"\n[devices.a]\n"),
            "[devices.a] in x.toml:2 (the device has no place) add x_m or remove the table");
  EXPECT_EQ(
      line_of("experiment = \"arena\"\n[devices.\"a b\"]\nx_m = 1\n"),
      "devices.a b.x_m in x.toml:3 (no name of a device) use letters, digits, - and _ for it");
  EXPECT_EQ(line_with("y = 1"),
            "devices.a.y in x.toml:4 (no such key) did you mean devices.a.y_m?");
}

TEST(ArenaRefusals, TwoDevicesOfOneName) {
  EXPECT_EQ(line_with("count = 3\n[devices.a-2]\nx_m = 1"),
            "devices.a-2 (another device is named a-2 too) rename one of the two");
}

TEST(ArenaRefusals, NumbersOutOfRange) {
  EXPECT_EQ(line_with("count = 0"),
            "devices.a.count = 0 in x.toml:4 (devices of this kind must be at least 1) use a whole "
            "number 1 to 1000");
  EXPECT_EQ(line_with("leds = 2.5"),
            "devices.a.leds = 2.5 in x.toml:4 (LEDs in even steps around the device: only whole "
            "numbers) use a whole number 1 to 36");
  EXPECT_EQ(
      line_with("interval_min_ms = 5000"),
      "devices.a.interval_min_ms = 5000 in x.toml:4 with devices.a.interval_max_ms = 900 by "
      "default (the shortest pause cannot exceed the longest) lower devices.a.interval_min_ms "
      "to 900 or raise devices.a.interval_max_ms to 5000");
  EXPECT_EQ(line_with("current_ma = 1200"),
            "devices.a.current_ma = 1200 in x.toml:4 (the data of TSAL6200 end at 997 mA) use at "
            "most 997");
  EXPECT_EQ(line_of(one + "[sweep]\ndevices.a.current_ma = [100, 1200]\n"),
            "devices.a.current_ma = 1200 in x.toml:5 (the data of TSAL6200 end at 997 mA) use at "
            "most 997");
}

TEST(ArenaRefusals, AWayThatTakesLongerThanARunMay) {
  EXPECT_EQ(line_with("[path]\nx_m = [0, 900]\nspeed_m_per_s = 0.01"),
            "path.speed_m_per_s = 0.01 in x.toml:6 (the way takes 90000 s, a run 86400 at most) "
            "raise it, or set arena.duration_s");
  EXPECT_EQ(line_with("[path]\nx_m = [0, 900]\nspeed_m_per_s = 0.01\n[arena]\nduration_s = 10"),
            "accepted");
}

TEST(ArenaRefusals, ATemperatureOfWhichADevicesOwnLedIsNotKnown) {
  EXPECT_EQ(line_with("led = \"IR333-A\"\n[led]\ntemperature_c = 40"),
            "led.temperature_c = 40 in x.toml:6 (the data of IR333-A hold for one temperature) use "
            "25");
}

TEST(ArenaRefusals, ListsThatAreNone) {
  EXPECT_EQ(line_with("[path]\nx_m = [0, 2000]"),
            "path.x_m = 2000 in x.toml:5 (way-points along x must be at most 1000 m) use a value "
            "-1000 to 1000");
  EXPECT_EQ(line_with("[path]\nx_m = [0, nan]"),
            "path.x_m = 0,nan in x.toml:5 (not a finite number) write a finite one");
  EXPECT_EQ(line_with("[path]\nx_m = \"0,far\""),
            "path.x_m = 0,far in x.toml:5 (\"far\" is not a number) write a:step:b, such as "
            "1:0.5:20, or a list, such as 1,2,5");
  EXPECT_EQ(line_with("[path]\nx_m = true"),
            "path.x_m in x.toml:5 (true or false where a list of numbers is expected) write [1, 2, "
            "5]");
  EXPECT_EQ(line_with("intervals_ms = [5, -1]"),
            "devices.a.intervals_ms = -1 in x.toml:4 (pauses in turn, instead of those must be at "
            "least 0 ms) use a value 0 to 1000000");
  std::string many = "intervals_ms = [1";
  for (int i = 0; i < 5000; ++i) many += ", 1";
  EXPECT_NE(line_with(many + ", inf]").find("..."), std::string::npos);
}

TEST(ArenaRefusals, ListsThatDoNotFit) {
  EXPECT_EQ(line_with("[path]\nx_m = [0, 1, 2]\ny_m = [0, 1]"),
            "path.y_m has 2 numbers (the way has 3 way-points) give one or 3");
}

TEST(ArenaRefusals, ListsAreNoSweep) {
  EXPECT_EQ(line_of(one + "[sweep]\npath.x_m = [1, 2]\n"),
            "path.x_m in x.toml:5 (text cannot be swept) write one scenario for each text");
}

TEST(ArenaRefusals, MessagesThatNobodyCanSend) {
  EXPECT_EQ(line_with("messages = [\"OK\", \"\\u0007\"]"),
            "devices.a.messages = \"OK??\" in x.toml:4 (byte 0x07 at position 0 is not printable "
            "ASCII, 0x20 to 0x7e) use printable ASCII, at most 252 characters");
  EXPECT_EQ(line_with("messages = \"A\\nB\""),
            "devices.a.messages in x.toml:4 (a line break in a message) write [\"A\", \"B\"] for "
            "several messages");
  EXPECT_EQ(line_with("messages = []"),
            "devices.a.messages in x.toml:4 (a list where a text or a list of texts is "
            "expected) write [\"A\", \"B\"]");
  const std::string long_one(250, 'x');
  EXPECT_EQ(line_of(one + "messages = \"" + long_one + "\"\n"), "accepted");
  EXPECT_EQ(line_of(one + "source = \"counter\"\nmessages = \"" + long_one + "\"\n"),
            "devices.a.messages = \"" + std::string(40, 'x') +
                "...\" (it becomes 250 characters) use at most 245");
  // The hundredth of a kind has a longer number: refused before the first point is run.
  EXPECT_EQ(line_of(one + "messages = \"" + std::string(248, 'x') +
                    "{}{}\"\n[sweep]\ndevices.a.count = [9, 100]\n"),
            "devices.a.messages = \"" + std::string(40, 'x') +
                "...\" (it becomes 254 characters) use at most 252");
}

TEST(ArenaRefusals, UnknownNames) {
  EXPECT_EQ(
      line_with("source = \"random\""),
      "devices.a.source = \"random\" in x.toml:4 (the choice of the message sent is one of a list) "
      "use fixed or list or counter or status");
  EXPECT_NE(line_with("led = \"TSAL9\"")
                .find("devices.a.led = \"TSAL9\" in x.toml:4 (no LED of this "
                      "name"),
            std::string::npos);
  EXPECT_EQ(line_of("experiment = \"arenas\"\n").find("experiment = \"arenas\" in x.toml:1 ("), 0u);
}

// What is said to be set can be.
TEST(ExperimentKinds, HaveTheKeyOfTheirAmount) {
  for (const ExperimentKind* kind : experiment_kinds())
    EXPECT_NE(find_key(std::string(kind->amount)), nullptr) << kind->name;
}

TEST(ArenaRefusals, KeysOfAnotherExperiment) {
  const auto expect = [](const std::string& line, const std::string& problem,
                         const std::string& experiment) {
    EXPECT_EQ(line.find(problem + ") remove it, or write experiment = "), 0U) << line;
    EXPECT_NE(line.find('"' + experiment + '"', problem.size()), std::string::npos) << line;
    EXPECT_TRUE(line.ends_with(" before the first table")) << line;
  };
  const std::string nothing = " (it means nothing in the experiment ";
  expect(line_of(one, {"receiver.range_m=3"}), "receiver.range_m in --set" + nothing + "\"arena\"",
         "link");
  EXPECT_EQ(line_of(one + "[stop]\nmax_frames = 5\n"),
            "stop.max_frames in x.toml:5" + nothing +
                "\"arena\") set arena.runs, or stop.rel_ci to end at a width of the interval");
  expect(line_of("[devices.a]\nx_m = 1\n"), "devices.a.x_m in x.toml:2" + nothing + "\"link\"",
         "arena");
  expect(line_of("[sweep]\narena.duration_s = [1, 2]\n"),
         "arena.duration_s in x.toml:2" + nothing + "\"link\"", "guard");
  EXPECT_EQ(
      line_of(one, {"receiver.module=ideal-coherent"}),
      "receiver.module = \"ideal-coherent\" in --set (an ideal receiver is told when bits are "
      "sent, and by one sender only) use a module");
}

}  // namespace
}  // namespace sim
