#pragma once
// Going on with what an interrupted run left in its result file.
#include <filesystem>
#include <string>

#include "sim/counting/shard.hpp"
#include "sim/program_info.hpp"
#include "sim/result/result.hpp"
#include "sim/scenario/scenario.hpp"

namespace sim {

/// Reads the counts of `path` into `result`, the same experiment before its first trial. Throws
/// Failure(bad_input) if they are of another scenario, seed, format or program, or damaged: only
/// trials that this program would have run in the same way can be gone on with.
void resume_from(const std::filesystem::path& path, const ProgramInfo& program,
                 ExperimentResult& result);

/// The checkpoint that an interrupted run of another experiment than a link left in `path`, of
/// those runs of a shard. Throws as resume_from.
std::string checkpoint_to_resume(const std::filesystem::path& path, const ProgramInfo& program,
                                 const LoadedScenario& scenario, const Shard& shard);

}  // namespace sim
