#pragma once
// What commands that judge decoders have in common.
#include <filesystem>
#include <string>
#include <vector>

#include "sim/check/baseline.hpp"
#include "sim/check/judged_point.hpp"
#include "sim/command/commands.hpp"

namespace sim {

/// Scenarios of links.
std::vector<LoadedScenario> load_links(const std::vector<std::filesystem::path>& scenarios,
                                       const ScenarioOptions& options, const std::string& command);

/// The decoder of a baseline, where it is built in. No file starts programs: throws
/// Failure(bad_input) where it is one, which the user must name.
std::string own_decoder(const Baseline& baseline);

/// "cosys-sim check: point 3 of 12 done" on stderr, unless `quiet`.
void show_progress(bool quiet, const std::string& command, std::size_t done, std::size_t of);

/// What is said after an interrupt, which leaves nothing behind.
ExitCode end_interrupted();

}  // namespace sim
