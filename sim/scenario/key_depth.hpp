#pragma once
#include <cstddef>
#include <optional>
#include <string_view>

namespace sim {

/// The most dots that a key of a TOML text may have.
inline constexpr int most_dots = 250;

/// The line, from 1 on, of the first key with more. To be asked before the text is parsed: the TOML
/// library takes a stack frame for each dot of a key, without a limit of its own.
std::optional<std::size_t> line_of_deep_key(std::string_view text);

}  // namespace sim
