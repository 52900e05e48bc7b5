#pragma once
// SigMF recordings (sigmf/SigMF 1.2): NAME.sigmf-meta says how NAME.sigmf-data beside it is to be
// read. All sample types of the standard; the first channel, or
// settings.wire, counted from 0. Annotations are not needed.
#include <filesystem>
#include <memory>

#include "sim/capture/capture_file.hpp"

namespace sim {

std::unique_ptr<SampleCapture> open_sigmf(const std::filesystem::path& meta,
                                          const CaptureSettings& settings);

}  // namespace sim
