#pragma once
// HDF5's library (1.10 to 1.14) falls over some damaged files instead of refusing them: see the
// issues 1368, 4351 and 5382 of github.com/HDFGroup/hdf5. Such a file must not take us along.
#include <filesystem>

namespace sim {

/// Whether the library survives the file's attributes, and each variable's description and first
/// cells: tried in a process of its own. True too of what the library refuses in order.
bool survives_reading(const std::filesystem::path& path);

}  // namespace sim
