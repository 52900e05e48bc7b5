#pragma once
// The reference of all keys for people, printed from the table that the program itself follows.
#include <string>

namespace sim {

/// The tables of scenarios/KEYS.md, in Markdown.
std::string key_reference();

}  // namespace sim
