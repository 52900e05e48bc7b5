#pragma once
// A traced trial in a file whose ending says the format. A new format is one row of the table in
// trace_file.cpp.
#include <filesystem>
#include <string>

#include "sim/trace/trace.hpp"
#include "sim/trace/trace_wishes.hpp"

namespace sim {

/// .vcd: wires tx and rx; .sr: the same, and every tap beside them if wished; .ook: the light of
/// rx; .bin: the wires as raw samples; .csv: time and every tap, a row a sample; .h5: the same and
/// spectra; .wav: the light at the module; .sigmf-meta: the same and its baseband, each with its
/// data beside it; .svg: a picture of light and pin.
void write_trace(const std::filesystem::path& path, TracedTrial trial,
                 const TraceWishes& wishes = {});

/// Throws the Failure that write_trace would throw for this name, before any work is done, and
/// refuses to replace a file that is no trace in this format.
void check_trace_path(const std::filesystem::path& path);

/// Throws Failure(bad_input) where the file's format cannot fulfil a wish, or where taps are to be
/// in the file and the scenario's fidelity has none.
void check_traceable(const std::filesystem::path& path, const Scenario& scenario,
                     const TraceWishes& wishes);

}  // namespace sim
