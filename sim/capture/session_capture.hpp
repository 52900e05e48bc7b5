#pragma once
// sigrok's session files (.sr; sigrok.org/wiki/File_format:Sigrok/v2, and v1 of sigrok 0.2): a zip
// of `metadata`, a key file, and of samples in members or chunks of them: logic-1, or logic-1-N;
// analogue ones (float, little endian) in analog-1-CHANNEL-N. Of several devices the first with
// logic samples is read. Chunk after chunk is unpacked as it is read.
#include <filesystem>

#include "sim/capture/capture_file.hpp"

namespace sim {

/// Fills in `logic`, or `samples` where settings.wire is an analogue channel or there is no other.
void open_session(const std::filesystem::path& path, const CaptureSettings& settings,
                  Capture& capture);

}  // namespace sim
