// All of a bench but the air: the sketch run by simavr, a module that hears what its pins do, the
// module's edges at the sketch's input, and what `cosys-sim fit` makes of the rows that it sends.
#include <nlohmann/json.hpp>

#include "bench_sketch.hpp"
#include "played_plan.hpp"
#include "sim/fit/bench_notes.hpp"

namespace sim {
namespace {

/// What the pins did, as a plan of single bursts: when, on which carrier and for how long is
/// theirs, how strong is that of the schedule (bench_sketch_test.cpp compares pins and widths).
Plan plan_of_light(const std::vector<PulseBurst>& bursts, std::int64_t zero,
                   const BenchSchedule& schedule) {
  Plan heard;
  std::size_t next = 0;
  for (const PlanStep& step : plan_of(schedule).steps)
    for (std::uint64_t repeat = 0; repeat < step.repeats && next < bursts.size(); ++repeat) {
      const PulseBurst& burst = bursts[next++];
      const double clocks =
          static_cast<double>(burst.last - burst.start) / static_cast<double>(burst.pulses - 1);
      heard.steps.push_back(
          {.start_ms = static_cast<double>(burst.start - zero) / clocks_per_us * 1e-3,
           .carrier_hz = clocks_per_us * 1e6 / clocks,
           .cycles_on = burst.pulses,
           .cycles_off = 0,
           .repeats = 1,
           .level_db = step.level_db});
    }
  EXPECT_EQ(next, bursts.size());
  return heard;
}

TEST_F(BenchSketch, MeasuredModuleIsFound) {
  const PartSources parts{.folders = {std::filesystem::path(COSYS_SOURCE_DIR) / "scenarios"},
                          .carried = {},
                          .carrier = {}};
  channel::ModuleData module = load_module("TSOP4856", parts, "").data;
  const double first_level = bench_first_level(module);
  module.agc_attack_db_per_ms = 0.12;
  module.agc_max_duty = 0.22;
  module.centre_hz = 56700;
  const BenchSchedule schedule = bench_schedule(5);
  build(schedule);
  play({});
  const PlayedLight alone = light(2 * longest_period);
  const std::int64_t zero = first_clock(schedule, alone);
  const Plan heard = plan_of_light(alone.bursts, zero, schedule);
  std::vector<PinEdge> edges;
  for (const double time_s : changes_of_output(heard, module, first_level))
    edges.push_back(
        {static_cast<double>(zero) / clocks_per_us + time_s * 1e6, edges.size() % 2 == 1});
  play(edges);
  write("plan.txt", plan_text(plan_of(schedule), bench_remarks("TSOP4856", first_level)));

  const Outcome o = program({"fit", "capture.csv", "--json"});
  ASSERT_EQ(o.code, 0) << o.err;
  const auto told = nlohmann::json::parse(o.out);
  EXPECT_TRUE(told["misfits"].empty()) << told["misfits"];
  std::size_t compared = 0;
  for (const auto& number : told["numbers"])
    for (const auto& [name, truth] : {std::pair{"agc_attack_db_per_ms", 0.12},
                                      {"agc_max_duty", 0.22},
                                      {"centre_hz", 56700.0},
                                      {"emin_mw_per_m2", module.emin_mw_per_m2}}) {
      if (number["name"] != name) continue;
      ASSERT_TRUE(number["is_told"]) << name;
      EXPECT_LE(number["low"], truth) << number;
      EXPECT_GE(number["high"], truth) << number;
      ++compared;
    }
  EXPECT_EQ(compared, 4U);
}

}  // namespace
}  // namespace sim
