#pragma once
// SigMF recordings (sigmf/SigMF 1.2): NAME.sigmf-meta says how NAME.sigmf-data beside it, or
// another file that it names, is to be read (sigmf_meta.hpp). All sample types of the standard; the
// first channel, or settings.wire, counted from 0. Captures follow each other without a gap.
#include <filesystem>
#include <memory>

#include "sim/capture/capture_file.hpp"

namespace sim {

std::unique_ptr<SampleCapture> open_sigmf(const std::filesystem::path& meta,
                                          const CaptureSettings& settings);

}  // namespace sim
