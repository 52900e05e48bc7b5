#pragma once
// Reads off CLI11's own description of the commands what they offer, so that nothing is said twice.
#include <CLI/CLI.hpp>
#include <string_view>

#include "sim/command/usage.hpp"

namespace sim {

/// What a check of CLI11 is named by, to say what it is for; behind those of words come the words,
/// behind that of parts their folders.
constexpr std::string_view place_check = "place", words_check = "words", some_words_check = "some",
                           key_check = "key", part_check = "part";

ProgramUsage usage_of(CLI::App& app);

}  // namespace sim
