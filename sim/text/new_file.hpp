#pragma once
// NewFile: a file written beside its place, which takes that place only when it is complete and on
// the disk; until then what was there stays, and a writer that gives up leaves nothing behind.
#include <deque>
#include <filesystem>
#include <string_view>

namespace sim {

/// All of it throws Failure(environment) where the machine refuses.
class NewFile {
 public:
  /// Opens PLACE.PID.tmp, and removes what killed processes left of theirs.
  explicit NewFile(const std::filesystem::path& place);
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;
  ~NewFile();

  void write(std::string_view bytes);
  /// All that was written is on the disk.
  void sync();
  void take_place();

 private:
  friend void take_places(std::deque<NewFile>& files);

  void refuse_what_is_no_file() const;
  [[noreturn]] void fail() const;
  [[noreturn]] void fail(const char* why, const char* suggestion) const;

  std::filesystem::path place_, beside_;
  int descriptor_ = -1;
  bool in_place_ = false;
};

/// Files that belong together take their places in order. A kill leaves no file beside an older one
/// that stood before another of them: what was there goes first, the last file's first.
void take_places(std::deque<NewFile>& files);

}  // namespace sim
