#pragma once
// The byte-order mark that programs of Windows put before a text (Unicode 15, 23.8): before UTF-8
// it says nothing and is passed over. UTF-16 is not read.
#include <cstddef>
#include <string>
#include <string_view>

namespace sim {

/// Bytes of the mark that a text begins with: 3 of UTF-8, else 0. Throws Failure(bad_input) for
/// UTF-16; `file` names it.
std::size_t mark_bytes(std::string_view text, const std::string& file);

}  // namespace sim
