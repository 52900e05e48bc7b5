#include "sim/page/scene_section.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace sim {
namespace {

std::vector<Setting> usual_scene() {
  return {{"device.baud", "600 Bd"},
          {"device.carrier_hz", "59000 Hz"},
          {"led.part", "TSAL6200"},
          {"led.current_ma", "100 mA"},
          {"led.height_mm", "12 mm"},
          {"receiver.module", "TSOP4856"},
          {"receiver.range_m", "0.5 .. 10 m (12 values)"},
          {"receiver.height_mm", "40 mm"},
          {"floor.part", "indoor"},
          {"ambient.irradiance_w_per_m2", "0.6 W/m2"},
          {"ambient.daylight_lux", "0 lx"},
          {"ambient.tungsten_lux", "0 lx"},
          {"disturbance.desk.kind", "led_panel"}};
}

std::string svg_of(const std::vector<Setting>& settings) {
  const auto section = scene_section(settings);
  return section ? section->picture->svg : "";
}

TEST(SceneSection, SaysWhereAndInWhatLight) {
  const std::string svg = svg_of(usual_scene());
  for (const char* words : {">TSAL6200, 100 mA<", ">59000 Hz, 600 Bd<", ">12 mm<", ">TSOP4856<",
                            ">40 mm<", ">0.5 .. 10 m (12 values)<", ">floor: indoor<",
                            ">0.6 W/m2 of ambient light<", ">another light (led_panel)<"})
    EXPECT_NE(svg.find(words), std::string::npos) << words;
  EXPECT_EQ(svg.find("daylight"), std::string::npos);
}

TEST(SceneSection, CutsWhatHasNoRoom) {
  std::vector<Setting> settings = usual_scene();
  std::ranges::find(settings, "receiver.module", &Setting::key)->value = std::string(300, '&');
  for (char lamp = 'a'; lamp < 'h'; ++lamp)
    settings.push_back({std::string("disturbance.") + lamp + ".kind", "fluorescent_electronic"});
  const std::string svg = svg_of(settings);
  EXPECT_NE(svg.find("&amp;...<"), std::string::npos);
  EXPECT_EQ(svg.find("fluorescent_electronic"), std::string::npos);
  EXPECT_NE(svg.find(">another...<"), std::string::npos);
}

// The light is said by the Eb/N0, wherever the parts stand.
TEST(SceneSection, IsNotOfAnEbN0) {
  std::vector<Setting> settings = usual_scene();
  settings.push_back({"receiver.ebn0_db", "4 dB"});
  EXPECT_FALSE(scene_section(settings));
}

}  // namespace
}  // namespace sim
