#include "sim/fit/bench_notes.hpp"

#include <fmt/format.h>

#include <cmath>

#include "sim/fit/arduino_sketch.hpp"
#include "sim/text/list_text.hpp"
#include "sim/text/number_text.hpp"

namespace sim {
namespace {

constexpr std::string_view notes_heading = "A bench of cosys-sim fit --plan\n";
constexpr std::string_view first_level_begins = "first level: ", first_level_ends = " mW/m2";

std::string minutes_and_seconds(double seconds) {
  const long whole = std::lround(std::ceil(seconds));
  return fmt::format("{}:{:02d}", whole / 60, whole % 60);
}

}  // namespace

std::vector<std::string> bench_remarks(const std::string& module, double first_level_mw_per_m2) {
  return {"",
          fmt::format("{}{:.3g}{}", first_level_begins, first_level_mw_per_m2, first_level_ends),
          "For a module like " + module + ", played by sketch/sketch.ino; README.txt says how.",
          "In what the sketch records, time 0 is that of the plan, by the same clock. A burst",
          "begins with its first pulse. Levels are those of the carrier's fundamental, as an LED",
          "TSAL6200 gives them by its sheet. They are estimated, not measured, to be right to 5 to",
          "10 %, and to 25 % below -48 dB, where what charges the wires counts.",
          ""};
}

std::optional<double> first_level_in(std::string_view plan_text) {
  for (std::string_view line : split(plan_text, '\n')) {
    if (!line.starts_with('#')) return std::nullopt;
    line = trimmed(line.substr(1));
    if (!line.starts_with(first_level_begins) || !line.ends_with(first_level_ends)) continue;
    line.remove_prefix(first_level_begins.size());
    line.remove_suffix(first_level_ends.size());
    return parse_number(line);
  }
  return std::nullopt;
}

std::string bench_notes(const BenchSchedule& schedule, const std::string& module,
                        double distance_m) {
  std::string text(notes_heading);
  text += fmt::format(
      R"(
Wire:    as in wiring.svg (LED: TSAL6200 or alike; module: like {0}).
Set:     LED and module {1:.2f} m apart, on each other's axis, 20 cm above the table, no lamp or sun on the module.
         A few cm more or less do not matter, but note the distance and the LED's type.
Load:    sketch/sketch.ino with the Arduino IDE (board: Uno). Close its serial monitor.
Record:  stty -F /dev/ttyACM0 {2} raw -echo && cat /dev/ttyACM0 > capture.csv
         Then press the Arduino's reset. The light L goes on, and out after {3}; then press Ctrl-C.
         The first line of capture.csv is time_s,rx: delete what stands before it.
Or:      a logic analyser on D7 (light on) and D8 (output), at 1 MS/s or more, saved as .sr, .vcd or .csv.
Next:    keep capture.csv beside plan.txt, and write: cosys-sim fit capture.csv -o modules/mine.toml
More:    near.csv, the first minute from {4:.2f} m, and lamp.csv, the same at {1:.2f} m under a lamp of, say, 10 W/m2:
         cosys-sim fit capture.csv near.csv lamp.csv --ambient 0,0,10 -o modules/mine.toml
)",
      module, distance_m, sketch_baud,
      minutes_and_seconds(static_cast<double>(clocks_of(schedule)) / bench_clock_hz + 2),
      distance_m / 8);
  return text;
}

}  // namespace sim
