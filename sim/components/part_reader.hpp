#pragma once
// What the text of one part's file says, checked against the keys that its kind may have.
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "sim/scenario/keys.hpp"

namespace sim {

/// How the source begins of a number that was measured of the very unit.
inline constexpr std::string_view source_of_measured = "measured";
/// And of a unit that does not do what the model does.
inline constexpr std::string_view source_of_misfit =
    "measured, but the part does not follow the rule";

/// Equal but for case, as names of parts are.
bool same_name(const std::string& a, const std::string& b);

/// A part whose numbers another takes where its own file is silent.
struct SiblingName {
  std::string name, place;
};

/// The sibling that a part's file names: like = "TSOP94256". Throws as read_part_text.
std::optional<SiblingName> sibling_of(const std::string& text, const std::filesystem::path& path);

/// The part in `text`. `path` is for messages, `stem` the name that the file gives it. Of what the
/// text does not say it is as `sibling`, where there is one.
/// Throws bad_input of anything missing, unknown, impossible or without its source. For the four
/// kinds in keys.hpp.
template <class Data>
Data read_part_text(const PartKeys<Data>& keys, const std::string& text,
                    const std::filesystem::path& path, const std::string& stem,
                    const Data* sibling = nullptr);

}  // namespace sim
