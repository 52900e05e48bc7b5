#pragma once
// The result file: HDF5 on the netCDF-4 model, so that xarray, ncdump and MATLAB open it.
// It is written beside its place and renamed, so a killed run leaves the last good file. HDF5 is
// not safe for threads: one thread writes.
#include <filesystem>
#include <string>

#include "sim/result.hpp"

namespace sim {

struct ProgramInfo {
  std::string name;
  std::string version;
  std::string commit;
};

/// Replaces `path` by a file with this result. Throws Failure(environment) and leaves what was
/// there untouched if the disk refuses.
void write_result(const std::filesystem::path& path, const ExperimentResult& result,
                  const ProgramInfo& program);

/// Throws the Failure that write_result would throw for this place: to be called before a run.
void check_writable(const std::filesystem::path& path);

}  // namespace sim
