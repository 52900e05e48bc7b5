#pragma once
// The light of a traced trial as two SigMF recordings (sigmf/SigMF 1.2.5): NAME.sigmf-meta and
// -data, its waveform (rf32_le, mW/m2), and NAME-baseband.sigmf-meta and -data, the carrier's
// complex amplitude (cf32_le, mW/m2; sim/trace/baseband). Both annotate each character that was
// sent.
#include <filesystem>
#include <string>
#include <vector>

#include "sim/trace/trace.hpp"

namespace sim {

/// The files of NAME.sigmf-meta in the order in which they are to take their places: metadata
/// names the hash of its data, so it comes last.
std::vector<std::filesystem::path> sigmf_places(const std::filesystem::path& meta);

/// What is in each of them.
std::vector<std::string> trace_as_sigmf(const TracedTrial& trial);

/// Whether one of these files is of such a trace: what the metadata says, also for its data.
bool is_sigmf_trace(const std::filesystem::path& place);

}  // namespace sim
