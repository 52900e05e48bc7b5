#include "sim/fit/bench_notes.hpp"

#include <fmt/format.h>

#include <cmath>

#include "sim/fit/arduino_sketch.hpp"
#include "sim/text/existing_file.hpp"

namespace sim {
namespace {

constexpr std::string_view notes_heading = "A bench of cosys-sim fit --plan\n";

std::string minutes_and_seconds(double seconds) {
  const long whole = std::lround(std::ceil(seconds));
  return fmt::format("{}:{:02d}", whole / 60, whole % 60);
}

}  // namespace

std::vector<std::string> bench_remarks(const std::string& module) {
  return {"",
          "For a module like " + module + ", played by sketch/sketch.ino; README.txt says how.",
          "In what the sketch records, time 0 is that of the plan, by the same clock. A burst",
          "begins with its first pulse. Levels are those of the carrier's fundamental, as an LED",
          "TSAL6200 gives them by its sheet. They are estimated, not measured, to be right to 5 to",
          "10 %, and to 25 % below -48 dB, where what charges the wires counts.",
          ""};
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
Next:    keep capture.csv beside plan.txt. This version does not read constants out of them yet; a later
         one will, of these formats.
)",
      module, distance_m, sketch_baud,
      minutes_and_seconds(static_cast<double>(clocks_of(schedule)) / bench_clock_hz + 2));
  return text;
}

bool is_written_notes(const std::filesystem::path& path) {
  return beginning_of(path, notes_heading.size()) == notes_heading;
}

}  // namespace sim
