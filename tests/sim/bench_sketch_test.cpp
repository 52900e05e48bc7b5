// The sketch of a bench, built by avr-gcc and run by simavr: what light its pins make is the plan's
// to the cycle, and what it sends of edges at its input are those edges.
//
// simavr (1.6) takes a new TOP at once and not at the end of the timer's cycle, so that steps on
// another carrier begin by the difference of the cycles later than they do, and are stamped so. It
// shows an edge at the end of the instruction during which it comes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <random>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "program.hpp"
#include "sim/capture/capture_file.hpp"
#include "sim/components/parts.hpp"
#include "sim/fit/arduino_sketch.hpp"
#include "sim/fit/plan_schedule.hpp"

namespace sim {
namespace {

constexpr double clocks_per_us = 16;

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

BenchSchedule bench_schedule(double minutes) {
  const PartSources parts{.folders = {std::filesystem::path(COSYS_SOURCE_DIR) / "scenarios"},
                          .carried = {},
                          .carrier = {}};
  return schedule_for(load_module("TSOP4856", parts, "").data, load_led("TSAL6200", parts, "").data,
                      minutes);
}

/// Every step of a plan, with less of all that takes time.
BenchSchedule hurried(BenchSchedule schedule) {
  for (BenchStep& step : schedule.steps) {
    step.lead = std::min<std::uint32_t>(step.lead, 60);
    step.on = std::min<std::uint32_t>(step.on, 700);
    step.repeats = std::min<std::uint32_t>(step.repeats, 3);
    step.off = std::min<std::uint32_t>(step.off, 300);
  }
  schedule.tail = 100;
  return schedule;
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

  /// The edges in capture.csv, by the reader that all captures have.
  std::vector<PinEdge> captured() const {
    const Capture capture = open_capture(path("capture.csv"), {});
    std::vector<PinEdge> edges;
    while (const auto level = capture.logic->next())
      if (!level->initial) edges.push_back({level->at.value * 1e6, level->level});
    return edges;
  }
};

std::int64_t signed_of(std::uint64_t clocks) { return static_cast<std::int64_t>(clocks); }

constexpr std::int64_t an_instruction = 8;  // clocks, that of an interrupt's return included

/// Bursts as the schedule has them, the first of which is at `zero`.
void expect_played(const BenchSchedule& schedule, const std::vector<PulseBurst>& bursts,
                   std::int64_t zero) {
  const std::vector<std::uint64_t> starts = starts_of(schedule);
  std::size_t next = 0;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const BenchStep& step = schedule.steps[i];
    const std::int64_t late = step.period - schedule.steps.front().period;
    for (std::uint32_t repeat = 0; repeat < step.repeats; ++repeat, ++next) {
      ASSERT_LT(next, bursts.size());
      const PulseBurst& burst = bursts[next];
      const std::int64_t start =
          zero + late + signed_of(starts[i]) +
          signed_of(std::uint64_t{repeat} * (step.on + step.off)) * step.period;
      ASSERT_EQ(burst.pulses, step.on) << "step " << i;
      ASSERT_EQ(burst.pins, std::set<int>{step.pulse.pin}) << "step " << i;
      ASSERT_LE(std::abs(burst.start - start), an_instruction) << "step " << i;
      ASSERT_LE(std::abs(burst.last - start - signed_of(step.on - 1) * step.period),
                an_instruction);
      ASSERT_LE(std::abs(burst.shortest - step.pulse.width), an_instruction);
      ASSERT_LE(std::abs(burst.longest - step.pulse.width), an_instruction);
    }
  }
  EXPECT_EQ(next, bursts.size()) << "and no other light";
}

std::int64_t first_clock(const BenchSchedule& schedule, const PlayedLight& light) {
  return light.bursts.empty() ? 0
                              : light.bursts.front().start - signed_of(starts_of(schedule).front());
}

/// The mark is high for as many cycles, from at most one before the first pulse on.
void expect_marked(const PlayedLight& light, double longest_cycle_us) {
  std::vector<double> rises, falls;
  for (const PinEdge& edge : light.mark)
    if (edge.is_high)
      rises.push_back(edge.us);
    else if (!rises.empty())
      falls.push_back(edge.us);
  ASSERT_EQ(rises.size(), light.bursts.size());
  ASSERT_EQ(falls.size(), light.bursts.size());
  for (std::size_t i = 0; i < rises.size(); ++i) {
    const double before = static_cast<double>(light.bursts[i].start) / clocks_per_us - rises[i];
    const double behind = falls[i] - static_cast<double>(light.bursts[i].last) / clocks_per_us;
    EXPECT_GT(before, 0);
    EXPECT_LT(before, longest_cycle_us);
    EXPECT_GT(behind, 0);
    EXPECT_LT(behind, longest_cycle_us);
  }
}

/// Edges of a module under way all the time, of whole microseconds as simavr takes them.
std::vector<PinEdge> drawn_edges(double from_us, double to_us, unsigned seed) {
  std::mt19937 draws(seed);
  std::uniform_int_distribution<int> rare(150, 900), often(250, 420);
  std::vector<PinEdge> edges;
  bool is_high = true;
  for (double at = from_us; at < to_us;
       at += (edges.size() / 200) % 2 == 0 ? rare(draws) : often(draws))
    edges.push_back({at, is_high = !is_high});
  return edges;
}

constexpr double power_up_us = 2e6;

TEST_F(BenchSketch, PlaysEachBurstOfThePlanToTheCycle) {
  const BenchSchedule schedule = hurried(bench_schedule(1));
  build(schedule);
  play({});
  const PlayedLight played = light(2 * longest_period);
  expect_played(schedule, played.bursts, first_clock(schedule, played));
  expect_marked(played, 317 / clocks_per_us);
  EXPECT_EQ(played.cut, 0U);
}

// The light is the same while edges come as often as they can last, and each is stamped.
TEST_F(BenchSketch, StampsEachEdgeOfTheModuleAndIsNotDisturbed) {
  const BenchSchedule schedule = hurried(bench_schedule(1));
  build(schedule);
  const double length_us = static_cast<double>(clocks_of(schedule)) / clocks_per_us;
  const std::vector<PinEdge> edges =
      drawn_edges(power_up_us + 5e3, power_up_us + length_us - 20e3, 1);
  play(edges);
  const PlayedLight played = light(2 * longest_period);
  const std::int64_t zero = first_clock(schedule, played);
  expect_played(schedule, played.bursts, zero);
  EXPECT_EQ(played.cut, 0U);

  const std::vector<PinEdge> stamped = captured();
  ASSERT_EQ(stamped.size(), edges.size());
  EXPECT_GT(edges.size(), 800U);
  double worst_us = 0;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    EXPECT_EQ(stamped[i].is_high, edges[i].is_high);
    const double error_us = stamped[i].us + static_cast<double>(zero) / clocks_per_us - edges[i].us;
    worst_us = std::max(worst_us, std::abs(error_us));
  }
  EXPECT_LT(worst_us, 31 / clocks_per_us + 0.7) << "what simavr is wrong by, and an instruction";
}

// Where a burst begins or ends the light is switched by an interrupt behind the end of a pulse: an
// edge about then is what delays it most.
TEST_F(BenchSketch, CutsNoPulseWhereAnEdgeComesAtItsEnd) {
  const BenchSchedule schedule = hurried(bench_schedule(1));
  build(schedule);
  play({});
  const PlayedLight alone = light(2 * longest_period);
  std::mt19937 draws(1);
  std::uniform_int_distribution<std::int64_t> about(-4 * 16, 8 * 16);
  std::vector<PinEdge> edges;
  for (const PulseBurst& burst : alone.bursts) {
    const bool at_end = edges.size() % 4 < 2;
    const std::int64_t pulse = at_end ? burst.last : burst.start - 286;
    const std::int64_t at = pulse + burst.longest + about(draws);
    edges.push_back({static_cast<double>(at) / clocks_per_us, edges.size() % 2 == 1});
  }
  play(edges);
  const PlayedLight played = light(2 * longest_period);
  EXPECT_EQ(played.cut, 0U);
  expect_played(schedule, played.bursts, first_clock(schedule, alone));
  EXPECT_EQ(captured().size(), edges.size());
}

// With its rests and its long carriers, as people run it.
TEST_F(BenchSketch, MeasuredAMinuteIsThePlan) {
  const BenchSchedule schedule = bench_schedule(1);
  build(schedule);
  play({});
  const PlayedLight played = light(2 * longest_period);
  expect_played(schedule, played.bursts, first_clock(schedule, played));
  EXPECT_EQ(played.cut, 0U);
}

TEST_F(BenchSketch, OfHalfAnHourHasRoom) {
  write("sketch.ino", arduino_sketch(bench_schedule(30), "TSOP4856"));
  tool("avr-gcc", {"-x", "c++", "-std=gnu++11", "-mmcu=atmega328p", "-DF_CPU=16000000UL", "-Os",
                   "-o", "sketch.elf", "sketch.ino"});
  std::istringstream sizes(tool("avr-size", {"sketch.elf"}));
  std::string heading;
  std::getline(sizes, heading);
  int text = 0, data = 0, bss = 0;
  sizes >> text >> data >> bss;
  EXPECT_LT(text + data, 32256) << "of an Uno, without its boot loader";
  EXPECT_LT(data + bss, 1024) << "half of the memory";
}

}  // namespace
}  // namespace sim
