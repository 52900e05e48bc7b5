#pragma once
// The sketch of a bench as simavr runs it: the light that its pins make, and what it sends of the
// edges at its input.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "program.hpp"
#include "sim/components/parts.hpp"
#include "sim/fit/arduino_sketch.hpp"
#include "sim/fit/plan_schedule.hpp"

namespace sim {

inline constexpr double clocks_per_us = 16;

struct PulseBurst {
  std::int64_t start = 0, last = 0;  // clocks: begin of the first and of the last pulse
  std::int64_t shortest = 0, longest = 0;
  std::uint32_t pulses = 0;
  std::set<int> pins;  // that were low
};

struct PinEdge {
  double us = 0;
  bool is_high = false;
};

/// What simavr has recorded: the light, and the mark of when it is on.
struct PlayedLight {
  std::vector<PulseBurst> bursts;
  std::vector<PinEdge> mark;
  std::size_t cut = 0;  // pulses during which a resistor was switched
};

inline BenchSchedule bench_schedule(double minutes) {
  const PartSources parts{.folders = {std::filesystem::path(COSYS_SOURCE_DIR) / "scenarios"},
                          .carried = {},
                          .carrier = {}};
  return schedule_for(load_module("TSOP4856", parts, "").data, load_led("TSAL6200", parts, "").data,
                      minutes);
}

/// Pulses of light, one after the other, as bursts.
class LightReader {
 public:
  /// Clocks without a pulse that end a burst.
  explicit LightReader(std::int64_t gap) : gap_(gap) {}

  void take(const std::string& wire, std::int64_t now, bool level) {
    if (wire == "mark") played_.mark.push_back({static_cast<double>(now) / clocks_per_us, level});
    if (wire.front() == 'd') switch_pin(wire.back() - '0', level);
    if (wire == "carrier" && level) begin_ = now;
    if (wire == "carrier" && !level && !low_.empty()) end_pulse(now);
    is_high_ = wire == "carrier" ? level : is_high_;
  }
  PlayedLight played() const { return played_; }

 private:
  void switch_pin(int pin, bool is_low) {
    played_.cut += is_high_;
    if (is_low)
      low_.insert(pin);
    else
      low_.erase(pin);
  }
  void end_pulse(std::int64_t now) {
    const std::int64_t width = now - begin_;
    if (played_.bursts.empty() || begin_ - played_.bursts.back().last > gap_)
      played_.bursts.push_back({begin_, begin_, width, width, 0, low_});
    PulseBurst& burst = played_.bursts.back();
    burst.last = begin_;
    burst.shortest = std::min(burst.shortest, width);
    burst.longest = std::max(burst.longest, width);
    ++burst.pulses;
    burst.pins.insert(low_.begin(), low_.end());
  }

  std::int64_t gap_, begin_ = 0;
  bool is_high_ = false;
  std::set<int> low_;
  PlayedLight played_;
};

class BenchSketch : public CommandLine {
 protected:
#ifndef COSYS_FIRMWARE
  void SetUp() override { GTEST_SKIP() << "needs avr-gcc, avr-libc and simavr"; }
#endif

  void build(const BenchSchedule& schedule) const {
    write("sketch.ino", arduino_sketch(schedule, "TSOP4856"));
    tool(
        "avr-gcc",
        {"-x", "c++", "-std=gnu++11", "-mmcu=atmega328p", "-DF_CPU=16000000UL", "-Os", "-Wall",
         "-Wextra", "-Werror", "-include", COSYS_SOURCE_DIR "/tests/firmware/sketch_wires.h",
         "-Wl,--undefined=_mmcu,--section-start=.mmcu=0x910000", "-o", "sketch.elf", "sketch.ino"});
  }

  /// Runs it with edges at its input. What it sends is left in capture.csv, its pins in sketch.vcd.
  void play(const std::vector<PinEdge>& edges) const {
    std::ostringstream vcd;
    vcd << "$timescale 1us $end\n$scope module logic $end\n$var wire 1 ! iogB_0 $end\n"
        << "$upscope $end\n$enddefinitions $end\n#0\n1!\n";
    for (const PinEdge& edge : edges)
      vcd << '#' << std::llround(edge.us) << '\n' << edge.is_high << "!\n";
    vcd << "#4000000000\n1!\n";  // simavr ends with the file, the sketch before
    write("pin.vcd", vcd.str());
    const Outcome o = start_tool("simavr", {"-i", "pin.vcd", "sketch.elf"}).finish();
    EXPECT_EQ(o.code, 0);
    write("capture.csv", sent(o.out + o.err));
  }

  /// simavr shows a line in colour, with its end as a dot.
  static std::string sent(const std::string& shown) {
    static const std::regex line("(time_s,rx|[0-9]{4}[.][0-9]{7},[01]|# [a-z: 0-9]+)[.]");
    std::string csv;
    for (std::sregex_iterator i(shown.begin(), shown.end(), line), end; i != end; ++i)
      csv += (*i)[1].str() + "\n";
    return csv;
  }

  /// `gap`: clocks without a pulse that end a burst.
  PlayedLight light(std::int64_t gap) const {
    std::istringstream vcd(content(path("sketch.vcd")));
    std::map<char, std::string> wires;
    LightReader reader(gap);
    std::int64_t now = 0;
    for (std::string line; std::getline(vcd, line);) {
      std::istringstream words(line);
      std::string var, wire, bits, name;
      char alias = 0;
      if (line.starts_with("$var") && words >> var >> wire >> bits >> alias >> name)
        wires[alias] = name;
      else if (line.starts_with('#'))
        now = std::llround((std::stod(line.substr(1)) + 0.4) * clocks_per_us / 100);  // 10 ns
      else if (line.size() == 2 && (line[0] == '0' || line[0] == '1'))
        reader.take(wires[line[1]], now, line[0] == '1');
    }
    return reader.played();
  }
};

inline std::int64_t signed_of(std::uint64_t clocks) { return static_cast<std::int64_t>(clocks); }

inline std::int64_t first_clock(const BenchSchedule& schedule, const PlayedLight& light) {
  return light.bursts.empty() ? 0
                              : light.bursts.front().start - signed_of(starts_of(schedule).front());
}

}  // namespace sim
