#pragma once
// Words as a POSIX shell takes them, for commands that users copy.
#include <string>

namespace sim {

/// In quotes where it needs some.
std::string shell_word(const std::string& word);

}  // namespace sim
