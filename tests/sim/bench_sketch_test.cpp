// The sketch of a bench, built by avr-gcc and run by simavr: what light its pins make is the plan's
// to the cycle, and what it sends of edges at its input are those edges.
//
// simavr (1.6) takes a new TOP at once and not at the end of the timer's cycle, so that steps on
// another carrier begin by the difference of the cycles later than they do, and are stamped so. It
// shows an edge at the end of the instruction during which it comes.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "bench_sketch.hpp"
#include "sim/capture/capture_file.hpp"

namespace sim {
namespace {

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

/// The edges in capture.csv, by the reader that all captures have.
std::vector<PinEdge> edges_of(const std::filesystem::path& csv) {
  const Capture capture = open_capture(csv, {});
  std::vector<PinEdge> edges;
  while (const auto level = capture.logic->next())
    if (!level->initial) edges.push_back({level->at.value * 1e6, level->level});
  return edges;
}

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

  const std::vector<PinEdge> stamped = edges_of(path("capture.csv"));
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
  EXPECT_EQ(edges_of(path("capture.csv")).size(), edges.size());
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
