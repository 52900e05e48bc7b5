#pragma once
// What somebody at the bench reads: the remarks at the head of the plan, and how to wire, set and
// record.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/fit/bench_light.hpp"

namespace sim {

/// Lines for the head of the plan. `first_level_mw_per_m2` is the irradiance of its first step at
/// the distance that the notes ask for.
std::vector<std::string> bench_remarks(const std::string& module, double first_level_mw_per_m2);

/// What such a head says that irradiance is; nothing where a text has no such line.
std::optional<double> first_level_in(std::string_view plan_text);

/// README.txt.
std::string bench_notes(const BenchSchedule& schedule, const std::string& module,
                        double distance_m);

}  // namespace sim
