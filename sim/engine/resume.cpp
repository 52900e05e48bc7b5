#include "sim/engine/resume.hpp"

#include <algorithm>
#include <string>

#include "sim/engine/engine.hpp"
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

}  // namespace

void resume_from(const std::filesystem::path& path, const ProgramInfo& program,
                 ExperimentResult& result) {
  const NetcdfReader file(path);
  const Origin own{NetcdfFile::format_version, program, result.seed, result.scenario_toml};
  const std::string why = mismatch(own, origin_of(file));
  if (!why.empty()) refuse(path, why);
  const std::vector<Shard> shards = result.shards;
  const bool whole =
      read_counts(file, result) && std::ranges::all_of(result.points, [](const PointResult& p) {
        return p.stop != StopReason::interrupted || is_resumable(p);
      });
  if (!whole) refuse(path, "its counts do not fit its digest: it is damaged");
  if (result.shards != shards)
    refuse(path, "it has other trials: shard " + shards_text(result.shards));
}

}  // namespace sim
