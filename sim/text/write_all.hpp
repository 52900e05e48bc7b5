#pragma once
// Writing to a descriptor in as many pieces as it takes.
#include <string_view>

namespace sim {

/// False, with its errno, where a write fails. A file that another process made non-blocking is
/// waited for.
bool write_all(int descriptor, std::string_view bytes);

}  // namespace sim
