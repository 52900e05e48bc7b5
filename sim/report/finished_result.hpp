#pragma once
// A finished result is kept, whatever became of its place while it was worked out.
#include <filesystem>
#include <functional>
#include <string>

namespace sim {

/// Writes it to `place`. Where that cannot be done any more, as on a disk that is full, it is
/// written to a new temporary folder, or else printed where there is `as_text`. Then what `write`
/// threw for `place` is thrown, and says where the result is.
void keep_finished(const std::filesystem::path& place,
                   const std::function<void(const std::filesystem::path&)>& write,
                   const std::function<std::string()>& as_text = {});

}  // namespace sim
