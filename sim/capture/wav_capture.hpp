#pragma once
// WAV and what else libsndfile reads of such files: sound cards and oscilloscopes.
#include <filesystem>

#include "sim/capture/capture_file.hpp"

namespace sim {

/// Its channels are called 1, 2 and so on. Samples are 1 at full scale.
void open_wav(const std::filesystem::path& path, const CaptureSettings& settings, Capture& capture);

}  // namespace sim
