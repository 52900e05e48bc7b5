#include "sim/resume.hpp"

#include <algorithm>
#include <string>

#include "sim/engine.hpp"
#include "sim/failure.hpp"
#include "sim/netcdf.hpp"
#include "sim/netcdf_reader.hpp"
#include "sim/stored_result.hpp"

namespace sim {
namespace {

void refuse(const std::filesystem::path& path, const std::string& why) {
  throw bad_input("cannot resume " + path.string(), why,
                  "leave out --resume to start anew, or name another -o");
}

void check_same_experiment(const std::filesystem::path& path, const NetcdfReader& file,
                           const ProgramInfo& program, const ExperimentResult& result) {
  if (file.text("format_version") != NetcdfFile::format_version)
    refuse(path, "it has another version of the format");
  if (file.text("version") != program.version || file.text("commit") != program.commit)
    refuse(path, "another version of the program counted it");
  if (file.whole_number("seed") != result.seed) refuse(path, "it has another seed");
  if (file.text("scenario_toml") != result.scenario_toml)
    refuse(path, "it is of another scenario, or of other options");
}

}  // namespace

void resume_from(const std::filesystem::path& path, const ProgramInfo& program,
                 ExperimentResult& result) {
  const NetcdfReader file(path);
  check_same_experiment(path, file, program, result);
  const bool whole =
      read_counts(file, result) && std::ranges::all_of(result.points, [](const PointResult& p) {
        return p.stop != StopReason::interrupted || is_resumable(p);
      });
  if (!whole) refuse(path, "its counts do not fit its digest: it is damaged");
}

}  // namespace sim
