#pragma once
// What both protocols take for text.
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace protocol {

constexpr bool is_printable(char c) { return c >= ' ' && c <= '~'; }
constexpr char upper_case(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

/// Two digits, lower case.
std::string hex_byte(std::uint8_t byte);

/// Of exactly two digits of either case.
std::optional<std::uint8_t> parse_hex_byte(std::string_view text);

}  // namespace protocol
