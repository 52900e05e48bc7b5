#pragma once
// A measured module as a part's file, which scenarios name: the numbers that the recording tells
// with their intervals, all others as those of the module that it is like, with their sources.
#include <filesystem>
#include <string>

#include "sim/components/parts.hpp"
#include "sim/fit/fit_result.hpp"

namespace sim {

/// The text of modules/NAME.toml. `capture` is the name of the recording's file, `remark` says
/// which light Emin holds for. Of one unit that was measured no spread of units is left: where Emin
/// or the centre is told, none is given.
std::string measured_part_text(const FittedModule& fit, const Part<channel::ModuleData>& like,
                               const std::string& name, const std::string& capture,
                               const std::string& remark = "");

/// Whether a file is such a text.
bool is_measured_part(const std::filesystem::path& path);

/// Unit of a number of a module's file: "dB/ms".
const std::string& unit_of_number(const std::string& key);

/// "centre_hz, q and agc_max_duty".
std::string list_in_words(const std::vector<std::string>& names);

/// Names of the numbers that the recording tells, or of those that it does not.
std::vector<std::string> number_names(const FittedModule& fit, bool are_told);

/// "short bursts: reported 20 ms later".
std::string misfit_words(const FitMisfit& misfit);

}  // namespace sim
