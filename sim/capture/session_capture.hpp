#pragma once
// sigrok's session files (.sr, version 2): a zip of `metadata` and of chunks of samples, logic ones
// in logic-1-N, analogue ones (float, little endian) in analog-1-CHANNEL-N. Chunk after chunk is
// unpacked as it is read.
#include <filesystem>

#include "sim/capture/capture_file.hpp"

namespace sim {

/// Fills in `logic`, or `samples` where settings.wire is an analogue channel or there is no other.
void open_session(const std::filesystem::path& path, const CaptureSettings& settings,
                  Capture& capture);

}  // namespace sim
