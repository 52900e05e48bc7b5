#include "sim/fit/arduino_sketch.hpp"

#include <fmt/format.h>

#include <cassert>
#include <limits>

#include "sim/fit/sketch_program.hpp"

namespace sim {
namespace {

constexpr std::string_view place_of_steps = "// STEPS\n";
constexpr std::string_view sketch_heading = "// A sketch of cosys-sim fit --plan\n";

template <class Number>
Number narrow(std::uint64_t value) {
  assert(value <= std::numeric_limits<Number>::max());
  return static_cast<Number>(value);
}

std::string row(int period, const BenchPulse& pulse, std::uint32_t lead, std::uint32_t on,
                std::uint32_t off, std::uint32_t repeats) {
  return fmt::format("  {{{}, {}, 1 << {}, {}, {}, {}, {}}},\n", period, pulse.width, pulse.pin,
                     lead, on, narrow<std::uint16_t>(off), narrow<std::uint16_t>(repeats));
}

std::string rows_of(const BenchSchedule& schedule) {
  std::string rows;
  for (const BenchStep& step : schedule.steps)
    rows += row(step.period, step.pulse, step.lead, step.on, own_gap(step), step.repeats);
  const BenchStep& last = schedule.steps.back();
  return rows + row(last.period, last.pulse, schedule.tail, 0, 0, 0);
}

}  // namespace

std::string arduino_sketch(const BenchSchedule& schedule, const std::string& module) {
  std::string text(sketch_heading);
  text += fmt::format("// It plays the plan in plan.txt, {:.1f} s of light for a module like {}.\n",
                      static_cast<double>(clocks_of(schedule)) / bench_clock_hz, module);
  const std::size_t at = sketch_program.find(place_of_steps);
  return text.append(sketch_program.substr(0, at))
      .append(rows_of(schedule))
      .append(sketch_program.substr(at + place_of_steps.size()));
}

}  // namespace sim
