#pragma once
// Going on with what an interrupted run left in its result file.
#include <filesystem>

#include "sim/counting/shard.hpp"
#include "sim/program_info.hpp"
#include "sim/scenario/scenario.hpp"

namespace sim {

/// Throws Failure(bad_input) if the counts of `path` are of another scenario, seed, format, program
/// or shard: only trials that this program would have run in the same way can be gone on with.
void check_resumable(const std::filesystem::path& path, const ProgramInfo& program,
                     const LoadedScenario& scenario, const Shard& shard);

}  // namespace sim
