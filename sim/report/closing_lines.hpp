#pragma once
// What is said below a table of points.
#include <filesystem>
#include <string>
#include <vector>

#include "sim/result/ranking.hpp"
#include "sim/result/result.hpp"

namespace sim {

/// Which trials of all these are; empty if none is missing.
std::string shards_note(const std::vector<Shard>& shards);

/// What was not counted of the experiment; empty if nothing is missing.
std::string missing_lines(const ExperimentResult& result);

/// What the marks mean, why frames were lost, where the loss passes the level, and where the counts
/// are kept.
std::string closing_lines(const ExperimentResult& result, const std::filesystem::path& kept_in,
                          const CrossingQuestion& question = {});

}  // namespace sim
