// What the report of a link says was simulated.
#include "sim/page/setup_words.hpp"

#include <gtest/gtest.h>

#include "sim/loading/load_scenario.hpp"

namespace sim {
namespace {

std::string words_in(const std::string& toml) {
  return setup_words(
      settings_of(parse_scenario(toml, "x.toml", {}, {COSYS_SOURCE_DIR "/scenarios"})));
}

TEST(SetupWords, SayWhoHearsWhatFromWhere) {
  EXPECT_EQ(
      words_in("led.current_ma = 50\nled.part = \"TSAL6200\"\nreceiver.module = \"TSSP4056\"\n"
               "[sweep]\nreceiver.range_m = \"1:1:20\"\n"),
      "TSSP4056 hears \"IND 011111 OK\" at 600 Bd on a carrier of 59000 Hz from a TSAL6200 "
      "at 50 mA, 1 .. 20 m (20 values) away, in 0.6 W/m2 of ambient light.\n");
}

TEST(SetupWords, SayThatEachOfSeveralModulesHears) {
  EXPECT_EQ(words_in("[sweep]\nreceiver.module = [\"TSSP4056\", \"TSOP4856\"]\n")
                .find("Each of TSSP4056, TSOP4856 hears \"IND"),
            0U);
  EXPECT_EQ(words_in("[sweep]\nreceiver.module = \"*\"\n").find("Each of GP1UX51QS .. TSSP96056 ("),
            0U);
}

TEST(SetupWords, NameEveryLightThatShines) {
  EXPECT_NE(words_in("ambient.irradiance_w_per_m2 = 0\n").find(" away, in the dark.\n"),
            std::string::npos);
  EXPECT_NE(words_in("ambient.daylight_lux = 500\n[disturbance.tv]\nkind = \"fluorescent\"\n")
                .find(", in 0.6 W/m2 of ambient light and 500 lx of daylight, beside another light "
                      "(fluorescent).\n"),
            std::string::npos);
}

TEST(SetupWords, AreDarkOnlyWhereNothingElseShines) {
  const std::string dark = "ambient.irradiance_w_per_m2 = 0\n";
  EXPECT_NE(words_in(dark + "[sweep]\nambient.daylight_lux = \"0:1000:10000\"\n")
                .find(" away, in 0 .. 10000 lx (11 values) of daylight.\n"),
            std::string::npos);
  EXPECT_NE(words_in(dark + "[disturbance.lamp]\nkind = \"fluorescent\"\n")
                .find(" away, beside another light (fluorescent).\n"),
            std::string::npos);
}

TEST(SetupWords, OfAGivenEbN0LeaveTheLightOut) {
  EXPECT_NE(words_in("receiver.module = \"ideal-coherent\"\nreceiver.ebn0_db = 9\n")
                .find(" Hz at Eb/N0 of 9 dB.\n"),
            std::string::npos);
}

TEST(SetupWords, ShortenALongMessage) {
  const std::string words = words_in("device.message = \"" + std::string(200, 'A') + "\"\n");
  EXPECT_NE(words.find('"' + std::string(60, 'A') + "...\""), std::string::npos) << words;
}

}  // namespace
}  // namespace sim
