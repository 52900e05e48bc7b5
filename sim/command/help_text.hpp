#pragma once
// What --help says, for a terminal of 80 columns: what a command does, an example, its arguments,
// then its options by what they are for.
#include <string>

#include "sim/command/usage.hpp"

namespace sim {

/// Of the program where `command` is empty. Options that are rarely needed have but their names, if
/// not `all` is asked for. Throws Failure(bad_input) of a command that there is not.
std::string help_text(const ProgramUsage& usage, const std::string& command, bool all);

}  // namespace sim
