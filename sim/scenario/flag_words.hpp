#pragma once
// Words of the keys of KeyType::flag: "false", "true", and of some keys one word for each value.
#include <optional>
#include <string>
#include <string_view>

#include "sim/scenario/key.hpp"

namespace sim {

/// The value that a word stands for: true, 1, false, 0, or one of the key's own.
std::optional<double> flag_value(const Key& key, std::string_view word);

std::string flag_word(const Key& key, double value);

/// "true or false", "false, parts or constants".
std::string flag_words(const Key& key);

}  // namespace sim
