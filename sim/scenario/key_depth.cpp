#include "sim/scenario/key_depth.hpp"

#include <algorithm>
#include <string>

namespace sim {
namespace {

/// One behind the last quote of the string that begins at `at`.
std::size_t end_of_string(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const bool many_lines = text.substr(at).starts_with(std::string(3, quote));
  const std::string_view mark = text.substr(at, many_lines ? 3 : 1);
  for (at += mark.size(); at < text.size() && !text.substr(at).starts_with(mark); ++at)
    at += quote == '"' && text[at] == '\\';
  at = std::min(at + mark.size(), text.size());
  if (!many_lines) return at;
  // Two quotes more may be its last text.
  const std::size_t end = text.find_first_not_of(quote, at);
  return std::min({end, at + 2, text.size()});
}

/// The end of the string or comment that begins at `at`; `at` if none does. A string may be part of
/// a key, but its dots divide none.
std::size_t behind_text(std::string_view text, std::size_t at) {
  if (text[at] == '"' || text[at] == '\'') return end_of_string(text, at);
  if (text[at] == '#') return std::min(text.find('\n', at), text.size());
  return at;
}

}  // namespace

std::optional<std::size_t> line_of_deep_key(std::string_view text) {
  constexpr std::string_view ends_of_keys = "=,[]{}\n";
  int dots = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t from = at;
    at = behind_text(text, from);
    if (at != from) continue;
    const char c = text[at++];
    if (ends_of_keys.find(c) != std::string_view::npos) dots = 0;
    dots += c == '.';
    if (dots > most_dots)
      return 1 + static_cast<std::size_t>(std::ranges::count(text.substr(0, from), '\n'));
  }
  return std::nullopt;
}

}  // namespace sim
