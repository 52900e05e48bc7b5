#pragma once
// Our own HDF5 traces (.h5 of `trace`), row by row: the wires tx and rx, or one of the taps.
#include <filesystem>

#include "sim/capture/capture_file.hpp"

namespace sim {

/// Fills in `logic`, or `samples` where settings.wire is a tap.
void open_netcdf(const std::filesystem::path& path, const CaptureSettings& settings,
                 Capture& capture);

}  // namespace sim
