// Floors, the bump and the LED's temperature, through a scenario's keys.
#include <filesystem>
#include <fstream>
#include <string>

#include "channel/floor.hpp"
#include "channel/photodiode.hpp"
#include "gtest/gtest.h"
#include "scenarios.hpp"
#include "sim/components/parts.hpp"
#include "sim/loading/load_scenario.hpp"
#include "sim/scenario/canonical_text.hpp"
#include "sim/scenario/keys.hpp"

namespace sim {
namespace {

Scenario scenario(const std::vector<std::string>& set) { return loaded("", set).base; }

channel::ReceivedLight light(std::vector<std::string> set) { return light_of(scenario(set)); }

// What floor keys stood for before there were floors as parts; published results rest on it.
TEST(Floors, TheDefaultIsAMiddlingIndoorFloor) {
  const channel::Floor floor = scenario({}).floor;
  EXPECT_EQ(floor.refractive_index, 1.5);
  EXPECT_EQ(floor.roughness_um, 5);
  EXPECT_EQ(floor.diffuse_reflectance, 0.3);
  EXPECT_EQ(floor.metal_reflectance, 0);
  EXPECT_EQ(floor.bump_height_mm, 0);
}

TEST(Floors, NoneIsFreeSpaceAndAMirrorNearlyDoublesTheLight) {
  const auto none = light({"floor.part=none"}), mirror = light({"floor.part=mirror"});
  EXPECT_EQ(none.specular.value, 0);
  EXPECT_EQ(none.diffuse.value, 0);
  EXPECT_EQ(mirror.diffuse.value, 0);
  // The image is seen 1.146 degrees down by LED and module, from 1.0002 m.
  EXPECT_NEAR(mirror.total() / none.total(), 1 + .9957 * .9909 * .9996, 2e-4);
}

TEST(Floors, EachGivesLessThanAMirror) {
  for (const char* part : {"indoor", "wood-varnished", "wood", "pvc", "tile", "concrete", "carpet"})
    for (const char* range : {"0.3", "1", "10"}) {
      const std::vector<std::string> set{std::string("receiver.range_m=") + range};
      const auto with = [&](const std::string& name) {
        auto all = set;
        all.push_back("floor.part=" + name);
        return light(all).total().value;
      };
      EXPECT_GT(with(part), with("none")) << part << range;
      EXPECT_LT(with(part), with("mirror")) << part << range;
    }
}

TEST(Floors, SingleNumbersOverrideThePart) {
  const auto floor = scenario({"floor.part=tile", "floor.roughness_um=7"}).floor;
  EXPECT_EQ(floor.roughness_um, 7);
  EXPECT_EQ(floor.diffuse_reflectance, 0.65);
  EXPECT_EQ(scenario({"floor.part=mirror", "floor.metal_reflectance=0.5"}).floor.metal_reflectance,
            0.5);
}

TEST(Floors, EqualFloorsAreOnePhysicsWhateverTheirNames) {
  EXPECT_EQ(canonical_text(scenario({"floor.part=none"})),
            canonical_text(scenario({"floor.part=mirror", "floor.metal_reflectance=0"})));
  EXPECT_NE(canonical_text(scenario({"floor.part=none"})),
            canonical_text(scenario({"floor.part=mirror"})));
}

TEST(Floors, AResultKeepsTheFile) {
  const std::string text = loaded("", {"floor.part=pvc"}).text;
  EXPECT_NE(text.find("\"floors/pvc.toml\""), std::string::npos);
  EXPECT_EQ(canonical_text(parse_scenario(text, "x.toml", {}, {}).base),
            canonical_text(scenario({"floor.part=pvc"})));
}

TEST(Floors, AnUnknownOneIsRefused) {
  const std::string line = refusal("[floor]\npart = \"tiles\"\n");
  EXPECT_TRUE(line.starts_with("floor.part = \"tiles\" in x.toml:2 (no floor of this name in "));
  EXPECT_TRUE(line.ends_with("did you mean tile?")) << line;
}

TEST(Bump, OfTenMillimetresHidesTheLed) {
  EXPECT_EQ(light({"floor.bump_height_mm=10"}).total().value, 0);
  EXPECT_EQ(light({"floor.bump_height_mm=9.9"}).direct, light({}).direct);
  EXPECT_GT(light({"floor.bump_height_mm=10", "receiver.height_mm=11"}).direct.value, 0);
}

TEST(LedTemperature, FadesTheTsal6200AsFig7) {  // T3: Vishay 81010 rev 2.4 Fig. 7
  const auto direct = [](const std::string& celsius) {
    return light({"floor.part=none", "led.temperature_c=" + celsius}).direct.value;
  };
  EXPECT_NEAR(direct("85") / direct("25"), .577, .03);
  EXPECT_NEAR(direct("-10") / direct("25"), 1.35, .03);
  EXPECT_EQ(direct("25"), light({"floor.part=none"}).direct.value);
}

TEST(LedTemperature, IsRefusedWhereTheDataEnd) {
  EXPECT_EQ(
      refusal("", {"led.temperature_c=101"}),
      "led.temperature_c = 101 in --set (the data of TSAL6200 span -10 to 100 degree_C) use a "
      "temperature between them");
  EXPECT_NE(refusal("", {"led.temperature_c=-20:10:100"}), "accepted");
  EXPECT_EQ(refusal("", {"led.temperature_c=-10:10:100"}), "accepted");
}

std::string led_file(const std::string& more) {
  return "[[part]]\n\"leds/x.toml\" = '''\nname = \"x\"\n" + more +
         "[intensity]\nma = [1, 1000]\nmw_per_sr = [1, 1000]\nsource = \"s\"\n'''\n[led]\npart = "
         "\"x\"\n";
}

const std::string half_angle = "half_angle_deg = { value = 60, source = \"s\" }\n";
const std::string pattern =
    "pattern = { degrees = [0, 90], relative_intensity = [1, 0], source = \"s\" }\n";

TEST(HalfAngle, StandsForThePattern) {
  const auto s = loaded(led_file(half_angle), {"floor.part=none", "led.yaw_deg=60"}).base;
  EXPECT_NEAR(light_of(s).total().value, .05, 1e-9);  // 100 mW/sr at 1 m, half of it at 60 degrees
}

TEST(HalfAngle, ExactlyOneOfTheTwoIsGiven) {
  const std::string at = "pattern and half_angle_deg in x.toml/leds/x.toml ";
  EXPECT_EQ(refusal(led_file("")), at + "(both are missing) add one of the two");
  EXPECT_EQ(refusal(led_file(half_angle + pattern)), at + "(both are given) remove one of the two");
  EXPECT_EQ(refusal(led_file(pattern)), "accepted");
}

TEST(LedTemperature, NeedsTheCurve) {
  EXPECT_EQ(refusal(led_file(half_angle), {"led.temperature_c=60"}),
            "led.temperature_c = 60 in --set (the data of x hold for one temperature) use 25");
  EXPECT_EQ(refusal(led_file(half_angle), {"led.temperature_c=25"}), "accepted");
}

TEST(Wavelength, BelongsToThePhysics) {
  const std::string green = "wavelength_nm = { value = 520, source = \"s\" }\n";
  EXPECT_NE(canonical_text(loaded(led_file(half_angle)).base),
            canonical_text(loaded(led_file(half_angle + green)).base));
}

TEST(Photodiodes, Bpw34IsTheSheets) {  // A1: Vishay 81521 rev 2.1
  const auto bpw34 =
      load_photodiode("BPW34", {{COSYS_SOURCE_DIR "/scenarios"}, {}, {}}, "asked").data;
  EXPECT_NEAR(photocurrent(bpw34, dsp::WattsPerSquareMetre(10)).value, 50e-6, 0.05e-6);
  EXPECT_NEAR(noise_equivalent_power(bpw34), 3.8e-14, 0.05e-14);
}

}  // namespace
}  // namespace sim
