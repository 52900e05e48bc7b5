#pragma once
// How long a UTF-8 text is on paper, as far as its letters tell.
#include <cstddef>
#include <string>
#include <string_view>

namespace sim {

/// Code points.
std::size_t letters_in(std::string_view text);

/// The text itself, or its beginning and "...", together `most` (>= 3) letters.
std::string shortened(const std::string& text, std::size_t most);

}  // namespace sim
