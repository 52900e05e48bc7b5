#pragma once
// How far two spellings of a name are from each other, case aside.
#include <cstddef>
#include <string>

namespace sim {

/// Edit distance (Levenshtein), except that a name cut short, as by a forgotten unit, is only one
/// slip.
std::size_t slips(const std::string& name, const std::string& candidate);

/// Whether a user may have meant the candidate, or what it is behind its dot: no more than a third
/// of the name is wrong.
bool is_near(const std::string& name, const std::string& candidate);

}  // namespace sim
