#include "sim/command/usage.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace sim {

std::string option_text(const OptionUsage& option) {
  const auto is_said = [&](const std::string& word) {
    return (option.value + option.help).find(word) != std::string::npos;
  };
  std::string text = option.help;
  if (option.kind == ValueKind::words && !std::ranges::all_of(option.words, is_said))
    text += fmt::format("; one of {}", fmt::join(option.words, ", "));
  std::vector<std::string> excludes = option.excludes;
  std::erase_if(excludes, [](const std::string& name) { return !name.starts_with("--"); });
  if (!excludes.empty()) text += fmt::format("; not with {}", fmt::join(excludes, ", "));
  return text;
}

}  // namespace sim
