#pragma once
// NewFile: a file written beside its place, which takes that place only when it is complete and on
// the disk; until then what was there stays, and a writer that gives up, or is told to end by a
// signal, leaves nothing behind. All files that users name as outputs are written so.
#include <deque>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "sim/threads/stop_signals.hpp"

namespace sim {

/// Those that the program may replace, as it wrote them itself.
struct OwnFiles {
  bool (*is_own)(const std::filesystem::path&);
  const char* name;  // "a result of cosys-sim"
};

/// Before the work of which the file is the result. Throws Failure(bad_input) where a file stands
/// that is not empty and not one of `own`, and as NewFile does where none can be written.
void check_place(const std::filesystem::path& place, const OwnFiles& own);

/// The first half of that, for a file whose folder is made later.
void refuse_to_lose(const std::filesystem::path& place, const OwnFiles& own);

/// A folder for files, with those around it, unless it is there. Throws Failure(environment).
void make_folder(const std::filesystem::path& folder);

/// The whole of a file.
void write_file(const std::filesystem::path& place, std::string_view bytes);

struct WholeFile {
  std::filesystem::path place;
  std::string text;
};
/// All of them or none, in folders that are made for them.
void write_files(const std::vector<WholeFile>& files);

/// All of it throws Failure(environment) where the machine refuses, and Failure(bad_input) for a
/// link that leads nowhere. One that leads to a file is written through.
class NewFile {
 public:
  /// Opens PLACE.PID.tmp, and removes what killed processes left of theirs.
  explicit NewFile(const std::filesystem::path& place);
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;
  ~NewFile();

  void write(std::string_view bytes);
  /// All that was written is on the disk, and nothing more can be written.
  void close();
  void take_place();

 private:
  friend void take_places(std::deque<NewFile>& files);

  void refuse_what_is_no_file() const;
  [[noreturn]] void fail() const;
  [[noreturn]] void fail(const char* why, const char* suggestion) const;

  EndPutOff until_in_place_;
  std::filesystem::path place_, beside_;
  int descriptor_ = -1;
  bool in_place_ = false;
};

/// Files that belong together take their places in order. The old ones are removed before, last to
/// first, so that a kill never leaves a new file beside an old one.
void take_places(std::deque<NewFile>& files);

}  // namespace sim
