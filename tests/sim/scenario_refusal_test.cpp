// What a scenario is refused for, and the line that says so.
#include <filesystem>

#include "gtest/gtest.h"
#include "scenarios.hpp"
#include "sim/failure.hpp"
#include "sim/loading/load_scenario.hpp"

namespace sim {
namespace {

namespace fs = std::filesystem;

struct Refusal {
  const char* text;
  const char* message;
};

class ScenarioRefuses : public testing::TestWithParam<Refusal> {};

TEST_P(ScenarioRefuses, InOneLineWithFileAndLine) {
  EXPECT_EQ(refusal(GetParam().text), GetParam().message);
}

const Refusal refusals[] = {
    {"\n[receiver]\nrange_m = -1",
     "receiver.range_m = -1 in x.toml:3 (distance along the floor must be at least 0.01 m) use a "
     "value 0.01 to 1000"},
    {"[receiver]\nrange_m = 0",
     "receiver.range_m = 0 in x.toml:2 (distance along the floor must be at least 0.01 m) use a "
     "value 0.01 to 1000"},
    {"[device]\n\n\ncarrier_duty = 1",
     "device.carrier_duty = 1 in x.toml:4 (lit fraction of a carrier period must be at most 0.99) "
     "use a value 0.01 to 0.99"},
    {"[device]\nbaud = inf",
     "device.baud = inf in x.toml:2 (not a finite number) use a value 1 to 100000"},
    {"[device]\nbaud = nan",
     "device.baud = nan in x.toml:2 (not a finite number) use a value 1 to 100000"},
    {"stop.max_frames = 1.5",
     "stop.max_frames = 1.5 in x.toml:1 (messages after which a point ends: only whole numbers) "
     "use a whole number 1 to 4000000000"},
    {"simulation.seed = 9007199254740993",
     "simulation.seed = 9007199254740992 in x.toml:1 (seed of all randomness must be at most "
     "9007199254740991) use a whole number 0 to 9007199254740991"},
    {"[receiver]\nrange = 3",
     "receiver.range in x.toml:2 (no such key) did you mean receiver.range_m?"},
    {"[receiver]\nrange_m = \"3 s\"",
     "receiver.range_m = \"3 s\" in x.toml:2 (\"s\" is no m) write the number in m"},
    {"[sweep]\nreceiver.range_m = \"1m:2s\"",
     "receiver.range_m = \"1m:2s\" in x.toml:2 (\"s\" is no m) write the number in m"},
    {"range_m = 3", "range_m in x.toml:1 (no such key) did you mean receiver.range_m?"},
    {"[reciever]\nrange_m = 3",
     "reciever.range_m in x.toml:2 (no such key) did you mean receiver.range_m?"},
    {"\n[sweeps]\n", "[sweeps] in x.toml:2 (no such table) did you mean [sweep]?"},
    {"[receiver]\nrange_m = \"3\"",
     "receiver.range_m in x.toml:2 (text where a number is expected) write a number without "
     "quotes; sweep in [sweep]"},
    {"[receiver]\nrange_m = [1, 2]",
     "receiver.range_m in x.toml:2 (a list where a number is expected) write a number without "
     "quotes; sweep in [sweep]"},
    {"[receiver]\nrange_m = true",
     "receiver.range_m in x.toml:2 (true or false where a number is expected) write a number "
     "without quotes; sweep in [sweep]"},
    {"[device]\nmessage = 5",
     "device.message in x.toml:2 (a number where text is expected) write the text in quotes"},
    {"[device]\nmessage = \"a\\nb\"",
     "device.message = \"a?b\" in x.toml:2 (byte 0x0a at position 1 is not printable ASCII, 0x20 "
     "to "
     "0x7e) use printable ASCII, at most 252 characters"},
    {"title = \"a\\tb\"",
     "title = \"a?b\" in x.toml:1 (a text is one line without control characters) remove them"},
    {"[uart]\nreceiver = \"avr\"",
     "uart.receiver = \"avr\" in x.toml:2 (the listening UART is one of a list) use atmega or "
     "mid-bit or software-serial or edge-timing"},
    {"\"led.yaw_deg\" = 1\n[led]\nyaw_deg = 2",
     "led.yaw_deg in x.toml:3 (given twice in this file) remove one of the two"},
    {"[sweep]\n'led.yaw_deg' = 1\nled.yaw_deg = 2",
     "sweep.led.yaw_deg in x.toml:3 (given twice in this file) remove one of the two"},
    {"[sweep]\nled.yaw_deg = [1, 2, 1]",
     "led.yaw_deg = 1 in x.toml:2 (twice in the same sweep) remove one of the two"},
    {"[sweep]\nled.yaw_deg = []",
     "led.yaw_deg in x.toml:2 (an empty sweep) write a:step:b, such as 1:0.5:20, or a list, such "
     "as 1,2,5"},
    {"[sweep]\nled.yaw_deg = \"1:0:2\"",
     "led.yaw_deg = \"1:0:2\" in x.toml:2 (the step is zero) write a:step:b, such as 1:0.5:20, or "
     "a list, such as 1,2,5"},
    {"[sweep]\nled.yaw_deg = \"1:1:200\"",
     "led.yaw_deg = 181 in x.toml:2 (direction of the LED along the floor must be at most 180 "
     "degree) use a value -180 to 180"},
    {"[sweep]\nstop.max_frames = [1, 2.5]",
     "stop.max_frames = 2.5 in x.toml:2 (messages after which a point ends: only whole numbers) "
     "use a whole number 1 to 4000000000"},
    {"[sweep]\nled.yaw_deg = [1, \"2\"]",
     "sweep.led.yaw_deg in x.toml:2 (a list that is not of numbers where a range or list is "
     "expected) write \"1:1:20\" or [1, 2, 5]"},
    {"[sweep]\nled.part = [1]",
     "sweep.led.part in x.toml:2 (a list where a list of texts is expected) write [\"A\", \"B\"] "
     "or "
     "\"*\" for all"},
    {"[sweep]\ndevice.message = ['a', 'b']",
     "device.message in x.toml:2 (text cannot be swept) write one scenario for each text"},
    {"[sweep]\nled.yaw_deg = ['1', '2']",
     "sweep.led.yaw_deg in x.toml:2 (a list of texts where a range or list is expected) write "
     "\"1:1:20\" or [1, 2, 5]"},
    {"[sweep]\nuart.receiver = ['atmega', 'avr']",
     "uart.receiver = \"avr\" in x.toml:2 (the listening UART is one of a list) use atmega or "
     "mid-bit or software-serial or edge-timing"},
    {"[sweep]\nyaw_dge = 1", "yaw_dge in x.toml:2 (no such key) did you mean led.yaw_deg?"},
    {"[sweep]\nled.yaw_deg = \"0:0.1:100\"\nreceiver.yaw_deg = \"0:0.1:100\"",
     "the sweep up to receiver.yaw_deg (more than 1000000 points) use a larger step or fewer axes"},
    {"[device]\ninterval_min_ms = 1000",
     "device.interval_min_ms = 1000 in x.toml:2 with device.interval_max_ms = 900 by default (the "
     "shortest pause cannot exceed the longest) lower device.interval_min_ms to 900 or raise "
     "device.interval_max_ms to 1000"},
    {"[sweep]\nsimulation.sample_rate_hz = [1e6, 230e3]\n[module]\ncentre_hz = 38000",
     "device.carrier_hz = 59000 by default with simulation.sample_rate_hz = 230000 in x.toml:2 (a "
     "carrier period takes at least 4 samples) lower device.carrier_hz to 57500 or raise "
     "simulation.sample_rate_hz to 236000"},
    {"module.centre_hz = 2.6e5\nsimulation.sample_rate_hz = 6e5",
     "module.centre_hz = 260000 in x.toml:1 with simulation.sample_rate_hz = 600000 in x.toml:2 (a "
     "period of the band-pass takes at least 4 samples) lower module.centre_hz to 150000 or raise "
     "simulation.sample_rate_hz to 1040000"},
    {"device.carrier_hz = 2e3",
     "device.baud = 600 by default with device.carrier_hz = 2000 in x.toml:1 (a bit takes at least "
     "4 carrier periods) lower device.baud to 500 or raise device.carrier_hz to 2400"},
    {"device.baud = 12e3\nsimulation.sample_rate_hz = 6e5",
     "device.baud = 12000 in x.toml:1 with simulation.sample_rate_hz = 600000 in x.toml:2 (a bit "
     "takes at least 100 samples) lower device.baud to 6000 or raise simulation.sample_rate_hz to "
     "1200000"},
    {"module.emax_w_per_m2 = 1e-5",
     "module.emin_mw_per_m2 = 0.12 from the part with module.emax_w_per_m2 = 1e-05 in x.toml:1 "
     "(the threshold cannot exceed the largest irradiance) lower module.emin_mw_per_m2 to 0.01 or "
     "raise module.emax_w_per_m2 to 0.00012"},
    {"[[device]]\nbaud = 600\n[[device]]\nbaud = 300",
     "device.baud in x.toml:4 (given twice in this file) remove one of the two"},
    {"\n[override]\nset = 'led.yaw_deg=3'",
     "override in x.toml:2 (not written as a table that may repeat) write [[override]]"},
    {"override = [{ set = 'led.yaw_deg=3' }]",
     "override in x.toml:1 (not written as a table that may repeat) write [[override]]"},
    {"[part]\n'leds/x.toml' = ''",
     "part in x.toml:1 (not written as a table that may repeat) write [[part]]"},
    {"\n[led]\ncurrent_ma = 1000",
     "led.current_ma = 1000 in x.toml:3 (the data of TSAL6200 end at 997 mA) use at most 997"},
    {"[sweep]\nled.current_ma = [997, 998]",
     "led.current_ma = 998 in x.toml:2 (the data of TSAL6200 end at 997 mA) use at most 997"},
    {"module.q = 0.5",
     "module.q = 0.5 in x.toml:1 (quality factor of the band-pass must be above 0.5) use a value "
     "above 0.5 up to 100"},
    {"[[override]]\nset = 'led.yaw_deg=x'",
     "led.yaw_deg = x in x.toml:2 (\"x\" is not a number) write a:step:b, such as 1:0.5:20, or a "
     "list, such as 1,2,5"},
};

INSTANTIATE_TEST_SUITE_P(Files, ScenarioRefuses, testing::ValuesIn(refusals));

TEST(Scenario, SetIsRefusedUnderItsOwnName) {
  EXPECT_EQ(refusal("", {"led.yaw_deg"}),
            "\"led.yaw_deg\" in --set (no = in it) write key=value, such as receiver.range_m=3");
  EXPECT_EQ(refusal("", {"=3"}),
            "\"=3\" in --set (no key before the =) write key=value, such as receiver.range_m=3");
  EXPECT_EQ(refusal("", {"simulation.seed=nan"}),
            "simulation.seed = nan in --set (not a finite number) write a finite one");
  EXPECT_EQ(refusal("", {"led.yaw=3"}), "led.yaw in --set (no such key) did you mean led.yaw_deg?");
  EXPECT_EQ(refusal("", {"receiver.range_m=-1"}),
            "receiver.range_m = -1 in --set (distance along the floor must be at least 0.01 m) use "
            "a value 0.01 to 1000");
  EXPECT_EQ(refusal("", {"led.yaw_deg="}),
            "led.yaw_deg =  in --set (no value) write a:step:b, such as 1:0.5:20, or a list, such "
            "as 1,2,5");
  EXPECT_EQ(refusal("", {"title=\xff"}).substr(0, 22), "syntax error in --set:");
  EXPECT_EQ(refusal("", {"device.message="}), "accepted");
  EXPECT_EQ(refusal("", {"device.message=" + std::string(252, 'x')}), "accepted");
  EXPECT_NE(refusal("", {"device.message=" + std::string(253, 'x')})
                .find("(its line would be 257 bytes long, 1 over the limit of 256) use"),
            std::string::npos);
}

TEST(Scenario, AKeyIsGuessedOnlyWhereItIsNear) {
  for (const char* far : {"foo.bar", "x", "led.qqqqqq"})
    EXPECT_EQ(refusal("", {std::string(far) + "=1"}),
              std::string(far) + " in --set (no such key) scenarios/KEYS.md lists all keys");
  for (const char* near : {"yaw_dge", "LED.YAW_DGE", "led.yaw", "led.jaw_deg", "led.yaw_degrees"})
    EXPECT_EQ(refusal("", {std::string(near) + "=1"}),
              std::string(near) + " in --set (no such key) did you mean led.yaw_deg?");
  EXPECT_EQ(refusal("[frobnicate]\n"),
            "[frobnicate] in x.toml:1 (no such table) scenarios/KEYS.md lists all tables");
}

TEST(Scenario, AnUnknownPartNamesTheNearestAndWhereItWasSought) {
  EXPECT_EQ(refusal("\n[receiver]\nmodule = \"TSOP4857\""),
            "receiver.module = \"TSOP4857\" in x.toml:3 (no module of this name in " +
                (scenarios / "modules").generic_string() + ") did you mean tsop4856?");
  EXPECT_THROW(parse_scenario("", "x.toml", {}, {}), Failure);
}

TEST(Scenario, SyntaxErrorsHaveTheirLine) {
  EXPECT_EQ(refusal("[led]\nyaw_deg = \n").substr(0, 24), "syntax error in x.toml:2");
  EXPECT_EQ(refusal("[led]\n\nyaw_deg = 1\nyaw_deg = 2\n").substr(0, 24),
            "syntax error in x.toml:4");
  EXPECT_EQ(refusal("title = \"\xff\"").substr(0, 24), "syntax error in x.toml:1");
}

TEST(Scenario, FilesThatAreNone) {
  const auto answer = [](const fs::path& path) -> std::string {
    try {
      load_scenario(path, {}, {scenarios});
    } catch (const Failure& failure) {
      return failure.what();
    }
    return "accepted";
  };
  EXPECT_EQ(answer("no/such.toml"), "no/such.toml (no such file) check the path");
  EXPECT_EQ(answer(scenarios),
            scenarios.generic_string() + " (a folder, not a scenario file) name a file in it");
  EXPECT_EQ(answer("/dev/zero"),
            "/dev/zero (longer than 1 MiB) shorten it or name a scenario file");
}

TEST(ScenarioLaw, DeepNestingIsRefused) {
  std::string dots = "\na", stairs;
  for (int i = 0; i < 100'000; ++i) dots += ".a";
  for (int i = 0; i < 200; ++i) {
    stairs += "a";
    for (int j = 0; j < 200; ++j) stairs += ".a";
    stairs += " = [{\n";
  }
  EXPECT_EQ(refusal(dots + " = 1"),
            "syntax error in x.toml:2 (more than 250 dots in a key) shorten the key");
  EXPECT_EQ(refusal("a = " + std::string(100'000, '[')).substr(0, 24), "syntax error in x.toml:1");
  EXPECT_EQ(refusal(stairs).substr(0, 23), "syntax error in x.toml:");
}

}  // namespace
}  // namespace sim
