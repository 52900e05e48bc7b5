#pragma once
// A result file read back.
#include <filesystem>

#include "sim/netcdf_reader.hpp"
#include "sim/result.hpp"

namespace sim {

/// Puts counts, reasons and costs of the file into the points of `result`, which must be those of
/// the same sweep. False if they do not fit the digest that the file has of them: it is damaged.
bool read_counts(const NetcdfReader& file, ExperimentResult& result);

/// A whole result: its axes are those of the scenario that it carries. Throws Failure(bad_input)
/// for a file that is none, or damaged.
ExperimentResult read_result(const std::filesystem::path& path);

}  // namespace sim
