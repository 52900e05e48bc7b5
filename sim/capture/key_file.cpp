#include "sim/capture/key_file.hpp"

#include <algorithm>

#include "sim/text/list_text.hpp"

namespace sim {
namespace {

std::string_view without_blanks(std::string_view text) {
  constexpr std::string_view white = " \t\r\f\v";
  const std::size_t first = std::min(text.find_first_not_of(white), text.size());
  return text.substr(first, text.find_last_not_of(white) + 1 - first);
}

/// "\s" is a blank, "\\" a backslash.
std::string unescaped(std::string_view text) {
  constexpr std::string_view letters = "sntr\\", meant = " \n\t\r\\";
  std::string value;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::size_t escape =
        text[i] == '\\' && i + 1 < text.size() ? letters.find(text[i + 1]) : std::string_view::npos;
    value += escape == std::string_view::npos ? text[i] : meant[escape];
    if (escape != std::string_view::npos) ++i;
  }
  return value;
}

}  // namespace

std::string KeyGroup::value(std::string_view key) const {
  const auto found = entries.find(key);
  return found == entries.end() ? "" : found->second;
}

std::vector<KeyGroup> read_key_file(std::string_view text) {
  std::vector<KeyGroup> groups;
  std::map<std::string, std::size_t, std::less<>> places;
  std::size_t place = 0;
  for (const std::string_view whole : split(text, '\n')) {
    const std::string_view line = without_blanks(whole);
    const std::size_t equal = line.find('=');
    if (line.starts_with('[') && line.ends_with(']')) {
      const std::string name(line.substr(1, line.size() - 2));
      place = places.try_emplace(name, groups.size()).first->second;
      if (place == groups.size()) groups.push_back({name, {}});
    } else if (!line.starts_with('#') && equal != std::string_view::npos && !groups.empty()) {
      groups[place].entries.insert_or_assign(std::string(without_blanks(line.substr(0, equal))),
                                             unescaped(without_blanks(line.substr(equal + 1))));
    }
  }
  return groups;
}

}  // namespace sim
