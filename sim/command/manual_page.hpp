#pragma once
// The manual page in troff's man macros: a section for each command, with its options.
#include <string>

#include "sim/command/usage.hpp"

namespace sim {

/// `date`: of the version, "2024-05-31"; it may be empty.
std::string manual_page(const ProgramUsage& usage, const std::string& version,
                        const std::string& date);

}  // namespace sim
