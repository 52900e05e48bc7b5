#pragma once
// What the text of one part's file says, checked against the keys that its kind may have.
#include <filesystem>
#include <string>

#include "sim/scenario/keys.hpp"

namespace sim {

/// Equal but for case, as names of parts are.
bool same_name(const std::string& a, const std::string& b);

/// The part in `text`. `path` is for messages, `stem` the name that the file gives it.
/// Throws bad_input of anything missing, unknown, impossible or without its source. For the four
/// kinds in keys.hpp.
template <class Data>
Data read_part_text(const PartKeys<Data>& keys, const std::string& text,
                    const std::filesystem::path& path, const std::string& stem);

}  // namespace sim
