#pragma once
// A result of an experiment that is not a link, read back from its file; and what the runs of any
// counted.
#include <filesystem>

#include "sim/result/dataset.hpp"
#include "sim/result/stored_result.hpp"
#include "sim/scenario/scenario.hpp"

namespace sim {

struct StoredDataset {
  LoadedScenario scenario;  // the one that it carries
  /// As it was written, but the variables are in the order of their names and dimensions in that of
  /// theirs. Without its checkpoint. Each variable has as many cells as its axes and dimensions
  /// say.
  Dataset data;
  Origin origin{};
};

/// Throws Failure(bad_input) for a file that is none, damaged, or of a newer format.
StoredDataset read_dataset(const std::filesystem::path& path);

/// What its runs counted, as read_dataset() leaves it out. Throws Failure(bad_input) where it is
/// damaged, or missing as in files of earlier versions.
std::string read_checkpoint(const std::filesystem::path& path);

}  // namespace sim
