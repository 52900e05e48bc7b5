#pragma once
// What somebody at the bench reads: the remarks at the head of the plan, and how to wire, set and
// record.
#include <filesystem>
#include <string>
#include <vector>

#include "sim/fit/bench_light.hpp"

namespace sim {

/// Lines for the head of the plan.
std::vector<std::string> bench_remarks(const std::string& module);

/// README.txt.
std::string bench_notes(const BenchSchedule& schedule, const std::string& module,
                        double distance_m);

/// Whether a file is such a README.txt.
bool is_written_notes(const std::filesystem::path& path);

}  // namespace sim
