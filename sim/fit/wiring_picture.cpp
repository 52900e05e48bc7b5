#include "sim/fit/wiring_picture.hpp"

#include <fmt/format.h>

#include <string_view>

#include "sim/fit/bench_light.hpp"
#include "sim/picture/path_data.hpp"
#include "sim/picture/svg.hpp"

namespace sim {
namespace {

// Pixels. A wire is drawn at the height of its pin of the Arduino.
constexpr double wiring_width = 800, wiring_height = 530;
constexpr double board_left = 30, board_right = 190, board_top = 60, board_bottom = 500;
constexpr double carrier_y = 90, level_y = 170, level_step = 30, output_y = 310, ground_y = 345,
                 supply_y = 380, mark_y = 450;
constexpr double cathode_x = 430, anode_y = 105, cathode_y = 150, lead = 8;
constexpr double resistor_left = 270, resistor_length = 70, resistor_height = 16;
constexpr double module_left = 620, module_right = 740, module_top = 85, module_bottom = 165;
constexpr double output_x = 645, ground_x = 680, module_supply_x = 715;
constexpr double analyser_left = 330, analyser_right = 560, analyser_top = 415;

constexpr const char* light_wire = "curve2 dot";
constexpr const char* output_wire = "curve1 dot";
constexpr const char* ground_wire = "curve8 dot";
constexpr const char* supply_wire = "curve4 dot";
constexpr const char* listening = "theory";

void draw_wire(SvgDrawing& drawing, const Polyline& corners, std::string_view style) {
  drawing.path(path_through(corners), style);
}

/// Where wires meet; those that only cross have none.
void draw_joint(SvgDrawing& drawing, SvgPoint at, std::string_view style) {
  drawing.path(fmt::format("M{:.1f} {:.1f}a2 2 0 1 0 4 0a2 2 0 1 0 -4 0Z", at.x - 2, at.y), style);
}

/// Along a wire, with what it is above it.
void draw_resistor(SvgDrawing& drawing, SvgPoint left, const std::string& what) {
  drawing.rectangle({left.x, left.y - resistor_height / 2}, resistor_length, resistor_height,
                    "frame");
  drawing.text({left.x + resistor_length / 2, left.y + 4}, what, "middle");
}

void draw_board_pin(SvgDrawing& drawing, double y, const std::string& name) {
  drawing.text({board_right - 8, y + 4}, name, "end");
}

void draw_board(SvgDrawing& drawing) {
  drawing.rectangle({board_left, board_top}, board_right - board_left, board_bottom - board_top,
                    "frame");
  drawing.rectangle({board_left, board_top}, board_right - board_left, board_bottom - board_top,
                    "floor");
  drawing.text({board_left + 12, board_top + 24}, "Arduino Uno", "heading");
  drawing.text({board_left + 12, board_top + 42}, "or Nano", "small");
  drawing.text({board_left + 12, board_bottom - 14}, "USB to the computer", "small");
}

void draw_led(SvgDrawing& drawing) {
  drawing.path(fmt::format("M{0} {2}H{1}L{3} {4}Z", cathode_x - 14, cathode_x + 14, anode_y + lead,
                           cathode_x, cathode_y - lead),
               light_wire);
  drawing.line({cathode_x - 14, cathode_y - lead}, {cathode_x + 14, cathode_y - lead}, light_wire);
  draw_wire(drawing, {{cathode_x, cathode_y - lead}, {cathode_x, cathode_y}}, light_wire);
  drawing.text({cathode_x - 24, (anode_y + cathode_y) / 2 + 4}, "infrared LED", "end");
}

void draw_carrier(SvgDrawing& drawing) {
  draw_board_pin(drawing, carrier_y, fmt::format("D{}", bench_carrier_pin));
  draw_wire(drawing,
            {{board_right, carrier_y}, {cathode_x, carrier_y}, {cathode_x, anode_y + lead}},
            light_wire);
  drawing.text({board_right + 12, carrier_y - 6}, "carrier, to the anode (long lead)", "small");
}

std::string ohms(double value) {
  return value < 1e3 ? fmt::format("{:g} Ω", value) : fmt::format("{:g} kΩ", value / 1e3);
}

void draw_levels(SvgDrawing& drawing) {
  double y = level_y;
  for (const BenchResistor& resistor : bench_resistors) {
    draw_board_pin(drawing, y, fmt::format("D{}", resistor.pin));
    draw_wire(drawing, {{board_right, y}, {resistor_left, y}}, light_wire);
    draw_resistor(drawing, {resistor_left, y}, ohms(resistor.ohm));
    draw_wire(drawing, {{resistor_left + resistor_length, y}, {cathode_x, y}}, light_wire);
    draw_joint(drawing, {cathode_x, y}, light_wire);
    y += level_step;
  }
  draw_wire(drawing, {{cathode_x, cathode_y}, {cathode_x, y - level_step}}, light_wire);
  drawing.text({cathode_x + 10, y - level_step + 4}, "to the cathode", "small");
}

void draw_beam(SvgDrawing& drawing, double distance_m) {
  const double y = (anode_y + cathode_y) / 2;
  const double from = cathode_x + 28, to = module_left - 14;
  drawing.line({from, y}, {to, y}, "light level");
  drawing.path(fmt::format("M{0} {1}L{2} {3}M{0} {1}L{2} {4}", to, y, to - 9, y - 5, y + 5),
               "light");
  drawing.text({(from + to) / 2, y - 10}, fmt::format("{:.2f} m", distance_m), "middle heading");
  drawing.text({(from + to) / 2, y + 20}, "facing each other", "middle small");
  drawing.text({(from + to) / 2, y + 36}, "nothing between or near", "middle small");
}

void draw_module(SvgDrawing& drawing, const std::string& module) {
  drawing.rectangle({module_left, module_top}, module_right - module_left,
                    module_bottom - module_top, "frame");
  drawing.rectangle({module_left, module_top}, module_right - module_left,
                    module_bottom - module_top, "floor");
  drawing.text({(module_left + module_right) / 2, module_top - 10}, "module like " + module,
               "middle");
  drawing.path(
      fmt::format("M{0} {1}a18 18 0 0 0 0 36", module_left + 18, (anode_y + cathode_y) / 2 - 18),
      "light");
  drawing.text({output_x, module_bottom - 6}, "OUT", "middle small");
  drawing.text({ground_x, module_bottom - 6}, "GND", "middle small");
  drawing.text({module_supply_x, module_bottom - 6}, "VS", "middle small");
}

void draw_output(SvgDrawing& drawing) {
  draw_board_pin(drawing, output_y, fmt::format("D{}", bench_module_pin));
  draw_wire(drawing, {{board_right, output_y}, {output_x, output_y}, {output_x, module_bottom}},
            output_wire);
  drawing.text({board_right + 12, output_y - 6}, "output of the module", "small");
}

/// With the 100 Ohm as in the application circuits of Vishay's sheets; newer ones have 0.1 uF.
void draw_capacitor(SvgDrawing& drawing) {
  const double y = 235, half = 10, middle = (ground_x + module_supply_x) / 2;
  draw_joint(drawing, {ground_x, y}, ground_wire);
  draw_joint(drawing, {module_supply_x, y}, supply_wire);
  draw_wire(drawing, {{ground_x, y}, {middle - 3, y}}, ground_wire);
  draw_wire(drawing, {{middle + 3, y}, {module_supply_x, y}}, supply_wire);
  drawing.line({middle - 3, y - half}, {middle - 3, y + half}, ground_wire);
  drawing.line({middle + 3, y - half}, {middle + 3, y + half}, supply_wire);
  drawing.text({module_supply_x + 8, y - 4}, "4.7 µF", "");
  drawing.text({module_supply_x + 8, y + 12}, "at the pins", "small");
}

void draw_supply(SvgDrawing& drawing) {
  draw_board_pin(drawing, ground_y, "GND");
  draw_wire(drawing, {{board_right, ground_y}, {ground_x, ground_y}, {ground_x, module_bottom}},
            ground_wire);
  draw_board_pin(drawing, supply_y, "5V");
  const double resistor_x = 500;
  draw_wire(drawing, {{board_right, supply_y}, {resistor_x, supply_y}}, supply_wire);
  draw_resistor(drawing, {resistor_x, supply_y}, "100 Ω");
  draw_wire(drawing,
            {{resistor_x + resistor_length, supply_y},
             {module_supply_x, supply_y},
             {module_supply_x, module_bottom}},
            supply_wire);
}

/// What is only for those who record with it.
void draw_analyser(SvgDrawing& drawing) {
  draw_board_pin(drawing, mark_y, fmt::format("D{}", bench_mark_pin));
  drawing.rectangle({analyser_left, analyser_top}, analyser_right - analyser_left, 84, "frame");
  drawing.text({analyser_left + 10, mark_y - 15}, "GND", "small");
  drawing.text({analyser_left + 10, mark_y + 4}, "light on (the drive)", "small");
  drawing.text({analyser_left + 10, mark_y + 23}, "output", "small");
  drawing.text({analyser_left + 130, mark_y + 4}, "logic analyser,", "");
  drawing.text({analyser_left + 130, mark_y + 20}, "if you like", "");
  draw_wire(drawing, {{board_right, mark_y}, {analyser_left, mark_y}}, listening);
  const double ground_tap = 290, output_tap = 260;
  draw_joint(drawing, {ground_tap, ground_y}, ground_wire);
  draw_wire(drawing,
            {{ground_tap, ground_y}, {ground_tap, mark_y - 19}, {analyser_left, mark_y - 19}},
            listening);
  draw_joint(drawing, {output_tap, output_y}, output_wire);
  draw_wire(drawing,
            {{output_tap, output_y}, {output_tap, mark_y + 19}, {analyser_left, mark_y + 19}},
            listening);
}

}  // namespace

std::string wiring_as_svg(const std::string& module, double distance_m) {
  SvgDrawing drawing(wiring_width, wiring_height, "Wires of the bench",
                     "An Arduino drives an infrared LED through one of three resistors and "
                     "records the output of a receiver module.");
  drawing.text({8, 24}, "Bench that measures a receiver module", "heading");
  draw_board(drawing);
  draw_carrier(drawing);
  draw_led(drawing);
  draw_levels(drawing);
  draw_beam(drawing, distance_m);
  draw_module(drawing, module);
  draw_output(drawing);
  draw_supply(drawing);
  draw_capacitor(drawing);
  draw_analyser(drawing);
  drawing.text({board_left, wiring_height - 12},
               "Wires that only cross are not joined. The order of the module's pins is in its "
               "data sheet.",
               "small");
  return drawing.finished();
}

}  // namespace sim
