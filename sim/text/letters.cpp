#include "sim/text/letters.hpp"

#include <algorithm>
#include <cassert>

namespace sim {
namespace {

constexpr std::string_view left_out = "...";

bool begins_letter(char c) { return (static_cast<unsigned char>(c) & 0xc0U) != 0x80U; }

}  // namespace

std::string in_lower_case(std::string_view text) {
  std::string low(text);
  for (char& c : low)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c + ('a' - 'A'));
  return low;
}

std::string capitalised(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z')
    text[0] = static_cast<char>(text[0] + ('A' - 'a'));
  return text;
}

std::size_t letters_in(std::string_view text) {
  return static_cast<std::size_t>(std::ranges::count_if(text, begins_letter));
}

std::string shortened(const std::string& text, std::size_t most) {
  assert(most >= left_out.size());
  if (letters_in(text) <= most) return text;
  std::size_t letters = 0;
  const auto end = std::ranges::find_if(
      text, [&](char c) { return begins_letter(c) && ++letters > most - left_out.size(); });
  return std::string(text.begin(), end).append(left_out);
}

}  // namespace sim
