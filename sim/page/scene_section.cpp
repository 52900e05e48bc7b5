#include "sim/page/scene_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

#include "sim/page/setup_words.hpp"
#include "sim/picture/path_data.hpp"
#include "sim/picture/svg.hpp"
#include "sim/text/letters.hpp"

namespace sim {
namespace {

// Pixels.
constexpr double scene_width = 720, scene_height = 264;
constexpr double floor_left = 20, floor_right = 700, floor_y = 204, floor_depth = 12;
constexpr double led_x = 110, module_x = 610, device_y = 164;
constexpr double dimension_y = 236, lamp_y = 54, tick = 4;

constexpr const char* direct_light = "light dot";
constexpr const char* mirrored_light = "light theory";

std::string fitting(const std::string& words, double room = 330) {
  constexpr double letter_width = 7;
  return shortened(words, static_cast<std::size_t>(std::max(room / letter_width, 3.0)));
}

/// With a tick at both ends.
void draw_dimension(SvgDrawing& drawing, SvgPoint from, SvgPoint to) {
  const bool is_level = from.y == to.y;
  drawing.line(from, to, "axis");
  for (const SvgPoint& end : {from, to})
    drawing.line({end.x - (is_level ? 0 : tick), end.y - (is_level ? tick : 0)},
                 {end.x + (is_level ? 0 : tick), end.y + (is_level ? tick : 0)}, "axis");
}

void draw_floor(SvgDrawing& drawing, const std::string& floor) {
  drawing.rectangle({floor_left, floor_y}, floor_right - floor_left, floor_depth, "floor");
  drawing.line({floor_left, floor_y}, {floor_right, floor_y}, "axis");
  drawing.text({floor_right, dimension_y + 4}, "floor: " + fitting(floor), "end small");
}

/// On a post as high as it is; words stand beside and above it.
struct StandingPart {
  double x;
  double away;  // +1: its height is said on its right side
  std::string name, what, height;
};

void draw_standing(SvgDrawing& drawing, const StandingPart& part) {
  constexpr double beside = 26, box_width = 14, box_height = 18;
  drawing.line({part.x, device_y}, {part.x, floor_y}, "axis");
  drawing.rectangle({part.x - box_width / 2, device_y - box_height / 2}, box_width, box_height,
                    "fill1");
  const double x = part.x + part.away * beside;
  draw_dimension(drawing, {x, device_y}, {x, floor_y});
  drawing.text({x + part.away * 8, (device_y + floor_y) / 2 + 4}, fitting(part.height),
               part.away > 0 ? "small" : "end small");
  const char* side = part.away > 0 ? "end" : "";
  const double from = part.away > 0 ? floor_right : floor_left;
  drawing.text({from, device_y - 40}, fitting(part.name), side);
  drawing.text({from, device_y - 24}, fitting(part.what), part.away > 0 ? "end small" : "small");
}

/// Each with its name, spread above the scene, and its light on the receiver.
void draw_lamps(SvgDrawing& drawing, const std::vector<std::string>& lights) {
  const double step = (floor_right - floor_left) / static_cast<double>(lights.size());
  double x = floor_left + step / 2;
  for (const std::string& light : lights) {
    drawing.text({x, lamp_y - 12}, fitting(light, step), "middle small");
    drawing.path(fmt::format("M{:g} {:g}a5 5 0 1 0 10 0a5 5 0 1 0 -10 0Z", x - 5, lamp_y), "fill2");
    drawing.line({x, lamp_y + 8}, {module_x, device_y - 12}, "level");
    x += step;
  }
}

std::string drawn_scene(const std::vector<Setting>& settings, const std::string& description) {
  const auto value = [&](const char* key) { return setting_value(settings, key); };
  SvgDrawing drawing(scene_width, scene_height, "The scene", description);
  drawing.text({floor_left, 18}, "The scene, not to scale", "heading");
  draw_floor(drawing, value("floor.part"));
  const std::vector<std::string> lights = other_lights(settings);
  if (!lights.empty()) draw_lamps(drawing, lights);
  drawing.path(
      path_through({{led_x, device_y}, {(led_x + module_x) / 2, floor_y}, {module_x, device_y}}),
      mirrored_light);
  drawing.line({led_x, device_y}, {module_x, device_y}, direct_light);
  draw_standing(drawing,
                {led_x, -1, value("led.part") + ", " + value("led.current_ma"),
                 value("device.carrier_hz") + ", " + value("device.baud"), value("led.height_mm")});
  draw_standing(drawing, {module_x, 1, value("receiver.module"), "receiver module",
                          value("receiver.height_mm")});
  draw_dimension(drawing, {led_x, dimension_y}, {module_x, dimension_y});
  drawing.text({(led_x + module_x) / 2, dimension_y + 18}, value("receiver.range_m"), "middle");
  return drawing.finished();
}

}  // namespace

std::optional<PageSection> scene_section(const std::vector<Setting>& settings) {
  const bool has_geometry = !setting_value(settings, "receiver.range_m").empty();
  if (!has_geometry || !setting_value(settings, "receiver.ebn0_db").empty()) return std::nullopt;
  std::string caption =
      "From the side, not to scale. Solid: the LED's light; dashed: by way of the floor.";
  std::string svg = drawn_scene(settings, caption);
  return PageSection{.heading = "The scene",
                     .picture = PagePicture{"scene", std::move(caption), std::move(svg)}};
}

}  // namespace sim
