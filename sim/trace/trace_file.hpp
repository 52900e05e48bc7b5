#pragma once
// A traced trial in a file whose ending says the format. A new format is one row of the table in
// trace_file.cpp.
#include <filesystem>
#include <string>

#include "sim/trace/trace.hpp"

namespace sim {

/// .vcd: wires tx and rx; .sr: the same and every tap beside them, where there are some; .ook: the
/// light of rx; .bin: the wires as raw samples; .csv: time and every tap, a row a sample; .h5: the
/// same and spectra; .wav: the light at the module; .sigmf-meta: the same and its baseband, each
/// with its data beside it; .svg: a picture of light and pin.
void write_trace(const std::filesystem::path& path, const TracedTrial& trial);

/// Throws the Failure that write_trace would throw for this name, before any work is done, and
/// refuses to replace a file that is no trace in this format.
void check_trace_path(const std::filesystem::path& path);

/// Throws Failure(bad_input) where the file's format has taps, and the scenario's fidelity none.
void check_traceable(const std::filesystem::path& path, const Scenario& scenario);

}  // namespace sim
