#pragma once
// A traced trial as HDF5 on the netCDF-4 model: every tap over time_s, and over frequency_hz the
// spectra of the light and of what the band-pass leaves of it.
#include <filesystem>
#include <string>

#include "sim/trace/trace.hpp"

namespace sim {

/// The whole file.
std::string trace_as_netcdf(const TracedTrial& trial);

/// Whether a file is such a trace.
bool is_netcdf_trace(const std::filesystem::path& path);

}  // namespace sim
