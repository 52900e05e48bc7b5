#pragma once
// Axes of texts: parts' names and choices, swept as numbers are. "TSOP4856,TSOP38256" is a list,
// "*" stands for all parts that are to be had, or for all choices.
#include <string>
#include <string_view>
#include <vector>

#include "sim/scenario/axis.hpp"
#include "sim/scenario/keys.hpp"

namespace sim {

constexpr std::string_view all_texts = "*";

/// Whether a key's texts can be swept: those of parts and choices can.
bool is_sweepable_text(const Key& key);

/// Whether a text is written as several: "A,B", "A," or "*".
bool is_text_list(std::string_view text);

/// Texts of "A,B"; a comma at the end may follow, so that "A," is a list of one.
std::vector<std::string> parse_texts(std::string_view text);

/// The axis of a part or choice: at least one text, none twice. "*" in an axis of parts stays as it
/// is, for only the folders of parts can tell what it is (sim/components/part_axis).
Axis make_text_axis(const Key& key, const std::vector<std::string>& texts,
                    const std::string& place);

/// Gives an axis other texts; throws if there is none or one twice.
void set_labels(Axis& axis, std::vector<std::string> labels, const std::string& place);

}  // namespace sim
