#pragma once
// The light of a traced trial as a WAV file, for sound editors and sox: one channel of floats. Full
// scale is the least power of two, in mW/m2, above every sample, so samples keep all their bits;
// the file's comment says it. The rate is rounded to whole hertz, as WAV has no others.
#include <filesystem>
#include <string>

#include "sim/trace/trace.hpp"

namespace sim {

/// The whole file: equal traces give equal bytes. Throws Failure(environment) for more than 4 GiB.
/// Sample i is the mean over the i-th sample period.
std::string trace_as_wav(const TracedTrial& trial);

/// Whether a file is such a trace.
bool is_wav_trace(const std::filesystem::path& path);

}  // namespace sim
