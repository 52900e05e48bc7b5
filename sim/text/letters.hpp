#pragma once
// Letters of a UTF-8 text: how long it is on paper, as far as they tell, and their case.
#include <cstddef>
#include <string>
#include <string_view>

namespace sim {

/// A character that moves the cursor of a terminal instead of printing.
constexpr bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

/// In lower case, as far as ASCII has it.
std::string in_lower_case(std::string_view text);

/// With its first letter a capital, as far as ASCII has it: a heading, or a sentence.
std::string capitalised(std::string text);

/// Code points.
std::size_t letters_in(std::string_view text);

/// The text itself, or its beginning and "...", together `most` (>= 3) letters.
std::string shortened(const std::string& text, std::size_t most);

}  // namespace sim
