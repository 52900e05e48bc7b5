#pragma once
// Where files go that nobody named.
#include <filesystem>

namespace sim {

/// That of TMPDIR, or /tmp. Throws Failure(environment) where it is no folder.
std::filesystem::path temporary_folder();

}  // namespace sim
