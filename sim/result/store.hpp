#pragma once
// The result file, of a format by the ending of its name: HDF5 on the netCDF-4 model
// (sim/result/netcdf), for xarray and others, or a table (sim/result/result_table) in .csv or
// .json. It is written beside its place and renamed, so a killed run leaves the last good file.
#include <filesystem>
#include <string>

#include "sim/program_info.hpp"
#include "sim/result/dataset.hpp"

namespace sim {

/// Replaces `path` by a file with this result. Throws Failure(environment) and leaves what was
/// there untouched if the disk refuses.
void write_dataset(const std::filesystem::path& path, const Dataset& data,
                   const ProgramInfo& program);

/// To be called before a run of any experiment: throws the Failure that writing its result would
/// throw for this place, and refuses an ending of no format, and to replace a file that is no
/// result.
void check_writable(const std::filesystem::path& path);

/// Whether the name ends as that of a result: "x.csv".
bool ends_as_result(const std::filesystem::path& path);

/// Refuses a table where its result has to be read again; `by` is the option that would.
void check_read_back(const std::filesystem::path& path, const std::string& by);

}  // namespace sim
