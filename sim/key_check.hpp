#pragma once
// Checks of what users write against the table of keys, and the one line that answers bad input.
// Whatever passes here may stand for its key; keys against each other are point_scenario's part.
#include <cstddef>
#include <string>
#include <vector>

#include "sim/failure.hpp"
#include "sim/keys.hpp"

namespace sim {

constexpr std::size_t longest_message = 250;  // a line of 256 bytes less checksum and newline

/// The candidate that is spelt most like `name` (case aside); empty if there are none. The part of
/// a candidate behind its dot counts too, so that "range_m" finds "receiver.range_m".
std::string nearest(const std::string& name, const std::vector<std::string>& candidates);

/// What a bad input is answered with: one line, PROBLEM (WHY) SUGGESTION.
Failure bad_input(const std::string& problem, const std::string& why,
                  const std::string& suggestion);

/// Throw unless the value may stand for the key; `place` says where it is written: "in x.toml:3".
void check_number(const KeyFacts& facts, double value, const std::string& place);
void check_text(const Key& key, const std::string& value, const std::string& place);

/// "above 0 up to 1000": an allowed range in words.
std::string in_words(const Range& range);

}  // namespace sim
