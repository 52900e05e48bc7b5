#pragma once
// A result file read back.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/program_info.hpp"
#include "sim/result/netcdf_reader.hpp"
#include "sim/result/result.hpp"
#include "sim/scenario/scenario.hpp"

namespace sim {

/// What counts come from. Those of the same origin were, or would be, counted in the same way.
struct Origin {
  std::string format_version;
  ProgramInfo program;
  std::uint64_t seed = 0;
  std::string scenario_toml;
};

Origin origin_of(const NetcdfReader& file);

/// Which trials or runs a result has; nothing where the file does not say it.
std::optional<std::vector<Shard>> shards_of(const NetcdfReader& file);

/// In what `other` is not the same as `own`, as words about "it"; empty where it is the same.
std::string mismatch(const Origin& own, const Origin& other);

/// The scenario that a result carries. Throws Failure(bad_input) where its format is newer than
/// ours, or the scenario cannot be read.
LoadedScenario readable_scenario(const Origin& origin, const std::filesystem::path& path);

struct StoredResult {
  Origin origin;
  LoadedScenario scenario;  // the one that it carries
  LinkResult result;        // without operating points, which follow from the scenario
};

/// Throws Failure(bad_input) for a file that is no result, or damaged.
StoredResult read_result(const std::filesystem::path& path);

}  // namespace sim
