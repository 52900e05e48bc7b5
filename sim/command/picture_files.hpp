#pragma once
// The pictures of a report as files by themselves, for papers.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/command/commands.hpp"
#include "sim/page/page.hpp"

namespace sim {

/// Throws Failure(environment) where the machine lacks what draws them.
void require_tools(const PictureFolders& folders);

struct PictureFile {
  std::filesystem::path place;
  std::string bytes;
};

/// All of a page's, drawn but not yet written; nothing if a signal stopped it. Throws
/// Failure(bad_input) where one would replace a file that is no picture of this program's.
std::optional<std::vector<PictureFile>> picture_files(const Page& page,
                                                      const PictureFolders& folders);

/// Makes the folders that are missing. Throws Failure(environment).
void make_folders(const PictureFolders& folders);

}  // namespace sim
