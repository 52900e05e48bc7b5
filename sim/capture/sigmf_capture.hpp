#pragma once
// SigMF recordings (sigmf/SigMF 1.2): NAME.sigmf-meta says how NAME.sigmf-data beside it, or
// another file that it names, is to be read (sigmf_meta.hpp). All sample types of the standard; its
// channels are called 1, 2 and so on. Captures follow each other without a gap.
#include <filesystem>

#include "sim/capture/capture_file.hpp"

namespace sim {

void open_sigmf(const std::filesystem::path& meta, const CaptureSettings& settings,
                Capture& capture);

}  // namespace sim
