#pragma once
// Reads a scenario with its parts, its sweep and the command line's changes, and refuses it unless
// each of its points holds.
#include <filesystem>
#include <string>
#include <vector>

#include "sim/scenario/scenario.hpp"

namespace sim {

/// Load a file. `overrides` are "key=value" as of --set, applied in order after the file's own
/// [[override]] tables; `roots` are folders that hold modules/, leds/, floors/ and
/// photodiodes/.
LoadedScenario load_scenario(const std::filesystem::path& path,
                             const std::vector<std::string>& overrides,
                             const std::vector<std::filesystem::path>& roots);

/// The same of a text in memory; `path` only names it in messages.
LoadedScenario parse_scenario(const std::string& text, const std::filesystem::path& path,
                              const std::vector<std::string>& overrides,
                              const std::vector<std::filesystem::path>& roots);

}  // namespace sim
