// Options of parts and locate.
#include "sim/command/command_options.hpp"
#include "sim/command/commands_added.hpp"

namespace sim {

void add_parts(CLI::App& app, PartsRequest& request) {
  auto& parts = *app.add_subcommand(
      "parts", "List modules, LEDs, floors and photodiodes, or show one with all its sources");
  parts
      .add_option("NAME", request.name,
                  "the part to show: its numbers, and the model beside the data sheet's curves")
      ->type_name("")
      ->check(a_part_of("modules leds floors photodiodes"));
  parts.add_option("--search", request.search, "list only parts whose file mentions this")
      ->type_name("TEXT");
  add_part_folders(parts, request.parts);
  parts.add_flag("--json", request.json, "JSON on stdout, not text");
  parts.footer("Example: cosys-sim parts TSOP4856");
}

void add_locate(CLI::App& app, LocateRequest& request) {
  auto& locate = *app.add_subcommand(
      "locate", "Say where a device is by the light that receivers measured: place and ellipse");
  add_place(
      locate, "READINGS", request.readings, "",
      "readings (.csv): x_m, y_m, heading_deg, irradiance_mw_per_m2 or photocurrent_ua, sigma "
      "or relative_sigma; bearing_deg, bearing_sigma_deg if measured; or a scenario of location "
      "(.toml), of which one trial is drawn")
      ->required();
  locate.add_option("--led", request.led, "the device's LED; TSAL6200 if not given")
      ->type_name("NAME")
      ->check(a_part_of("leds"));
  locate.add_option("--led-current-ma", request.led_current_ma, "its current; 100 if not given")
      ->type_name("MA")
      ->check(between(1e-3, 1e4));
  locate
      .add_option("--led-yaw-deg", request.led_yaw_deg,
                  "where it looks, from +x to +y; if not given, it is as bright to all sides")
      ->type_name("DEG")
      ->check(between(-360, 360));
  locate.add_option("--floor", request.floor, "indoor if not given")
      ->type_name("NAME")
      ->check(a_part_of("floors"));
  locate.add_option("--photodiode", request.photodiode, "the receivers'; BPW34 if not given")
      ->type_name("NAME")
      ->check(a_part_of("photodiodes"));
  locate
      .add_option("--height-mm", request.height_mm,
                  "of LED and receivers above the floor; 10 if not given")
      ->type_name("MM")
      ->check(between(0.1, 1e4));
  locate
      .add_option("--area", request.area,
                  "where the device may be: x from, to, y from, to in metres, -3,3,0,5")
      ->type_name("X,X,Y,Y")
      ->delimiter(',')
      ->expected(4)
      ->check(between(-1e4, 1e4));
  locate.add_flag("--unknown-intensity", request.intensity_unknown,
                  "find the LED's intensity too, as a factor to the sheet's; needs --area");
  locate
      .add_option("--point", request.point,
                  "of a scenario: point of the sweep, counted from 0; 0 if not given")
      ->type_name("K")
      ->check(an_index);
  locate
      .add_option("--trial", request.trial, "of a scenario: trial, counted from 0; 0 if not given")
      ->type_name("N")
      ->check(an_index)
      ->check(between(0, last_trial));
  add_scenario_options(locate, request.options);
  add_place(locate, "-o,--output", request.output, "FILE",
            "table of places: .csv or .json (JSON lines)");
  locate.add_flag("--json", request.json, "one JSON object on stdout, not text");
  locate.footer(
      "Exit code 4 if the readings leave it open. Example: cosys-sim locate "
      "scenarios/readings/four_receivers.csv");
}

}  // namespace sim
