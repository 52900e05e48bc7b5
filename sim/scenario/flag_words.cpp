#include "sim/scenario/flag_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace sim {

std::optional<double> flag_value(const Key& key, std::string_view word) {
  if (word == "false" || word == "0") return 0;
  if (word == "true" || word == "1") return 1;
  const auto at = std::ranges::find(key.choices, word);
  if (at == key.choices.end()) return std::nullopt;
  return static_cast<double>(at - key.choices.begin());
}

std::string flag_word(const Key& key, double value) {
  return key.choices.at(static_cast<std::size_t>(value));
}

std::string flag_words(const Key& key) { return fmt::format("{}", fmt::join(key.choices, " or ")); }

}  // namespace sim
