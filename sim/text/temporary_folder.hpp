#pragma once
// Where files go that nobody named.
#include <filesystem>
#include <string>

namespace sim {

/// That of TMPDIR, or /tmp. Throws Failure(environment) where it is no folder.
std::filesystem::path temporary_folder();

/// A new one in it, of this user alone, whose name begins so. Throws Failure(environment).
std::filesystem::path new_temporary_folder(const std::string& name_begin);

}  // namespace sim
