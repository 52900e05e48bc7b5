#pragma once
// Checks of what users write against the table of keys. Whatever passes here may stand for its key;
// keys against each other are point_scenario's part.
#include <string>

#include "sim/failure.hpp"
#include "sim/scenario/keys.hpp"

namespace sim {

/// Throw unless the value may stand for the key; `place` says where it is written: "in x.toml:3".
void check_number(const KeyFacts& facts, double value, const std::string& place);
void check_text(const Key& key, const std::string& value, const std::string& place);

/// "above 0 up to 1000": an allowed range in words.
std::string in_words(const Range& range);

}  // namespace sim
