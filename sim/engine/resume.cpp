#include "sim/engine/resume.hpp"

#include <string>

#include "sim/failure.hpp"
#include "sim/result/netcdf.hpp"
#include "sim/result/netcdf_reader.hpp"
#include "sim/result/stored_result.hpp"

namespace sim {
namespace {

void refuse(const std::filesystem::path& path, const std::string& why) {
  throw bad_input("cannot resume " + path.string(), why,
                  "leave out --resume to start anew, or name another -o");
}

void refuse_other(const std::filesystem::path& path, const Origin& own, const Origin& other) {
  const std::string why = mismatch(own, other);
  if (!why.empty()) refuse(path, why);
}

void refuse_other_shards(const std::filesystem::path& path, const std::vector<Shard>& own,
                         const std::vector<Shard>& other) {
  if (other.size() > 1)
    throw bad_input("cannot resume " + path.string(),
                    "it was merged of the shards " + shards_text(other),
                    "go on with those of them that are unfinished, and merge again");
  if (other != own) refuse(path, "it has other trials: shard " + shards_text(other));
}

}  // namespace

void check_resumable(const std::filesystem::path& path, const ProgramInfo& program,
                     const LoadedScenario& scenario, const Shard& shard) {
  const auto seed = static_cast<std::uint64_t>(scenario.base.simulation.seed);
  const NetcdfReader file(path);
  refuse_other(path, {NetcdfFile::format_version, program, seed, scenario.text}, origin_of(file));
  refuse_other_shards(path, {shard}, shards_of(file).value_or(std::vector<Shard>{}));
}

}  // namespace sim
