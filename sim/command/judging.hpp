#pragma once
// What commands that judge decoders have in common.
#include <filesystem>
#include <string>
#include <vector>

#include "sim/check/judged_point.hpp"
#include "sim/command/commands.hpp"

namespace sim {

/// Scenarios of links.
std::vector<LoadedScenario> load_links(const std::vector<std::filesystem::path>& scenarios,
                                       const ScenarioOptions& options, const std::string& command);

/// "cosys-sim check: point 3 of 12 done" on stderr, unless `quiet`.
void show_progress(bool quiet, const std::string& command, std::size_t done, std::size_t of);

/// What is said after an interrupt, which leaves nothing behind.
ExitCode end_interrupted();

}  // namespace sim
