#pragma once
// WAV and what else libsndfile reads of such files: sound cards and oscilloscopes.
#include <filesystem>
#include <memory>
#include <string>

#include "sim/capture/sample_capture.hpp"

namespace sim {

/// `channel`: its number, counted from 0; empty: the first. Samples are 1 at full scale.
std::unique_ptr<SampleCapture> open_wav(const std::filesystem::path& path,
                                        const std::string& channel);

}  // namespace sim
