#include "sim/text/escaped_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <utility>

#include "protocol/ascii.hpp"

namespace sim {
namespace {

std::string escaped(char c) {
  if (c == '\\') return "\\\\";
  if (protocol::is_printable(c)) return std::string(1, c);
  return fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
}

/// Of the letter at the beginning; 0 for what is none, is ASCII, or moves what stands around it.
std::size_t bytes_of_letter(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint32_t>(text[i] & 0xff); };
  const std::uint32_t first = byte(0);
  const std::size_t size = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || text.size() < size) return 0;
  std::uint32_t code = first & (0x7fU >> size);
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xc0U) != 0x80U) return 0;
    code = code << 6U | (byte(i) & 0x3fU);
  }
  constexpr std::pair<std::uint32_t, std::uint32_t> no_letters[] = {
      {0, 0xa0},        {0x61c, 0x61c},   {0x200b, 0x200f}, {0x2028, 0x202e}, {0x2060, 0x206f},
      {0xd800, 0xf8ff}, {0xfe00, 0xfe0f}, {0xfeff, 0xfeff}, {0xfff0, 0xffff}, {0xe0000, 0x10ffff}};
  constexpr std::uint32_t smallest[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool is_none =
      code < smallest[size] || std::ranges::any_of(no_letters, [code](const auto& range) {
        return code >= range.first && code <= range.second;
      });
  return is_none ? 0 : size;
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string shown;
  for (const char c : text) shown += escaped(c);
  return shown;
}

std::string escaped_name(std::string_view text) {
  std::string shown;
  while (!text.empty()) {
    const std::size_t size = bytes_of_letter(text);
    shown += size > 0 ? std::string(text.substr(0, size)) : escaped(text.front());
    text.remove_prefix(std::max<std::size_t>(size, 1));
  }
  return shown;
}

}  // namespace sim
