#pragma once
// A traced trial as HDF5 on the netCDF-4 model: every tap over time_s, and over frequency_hz the
// spectra of the light and of what the band-pass leaves of it.
#include <string>

#include "sim/trace.hpp"

namespace sim {

/// The whole file.
std::string trace_as_netcdf(const TracedTrial& trial);

}  // namespace sim
