#include "sim/check/capture_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "sim/failure.hpp"
#include "sim/text/temporary_folder.hpp"
#include "sim/text/write_all.hpp"

namespace sim {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view name_begin = "cosys-sim-captures.";

Descriptor opened(const fs::path& folder) {
  return Descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
}

bool is_unlocked(const Descriptor& folder) { return ::flock(folder.get(), LOCK_EX | LOCK_NB) == 0; }

/// Waits for who holds it at the moment. A file system without locks has none.
void lock(const Descriptor& folder) {
  while (::flock(folder.get(), LOCK_EX) != 0 && errno == EINTR) continue;
}

/// As mkdtemp makes them for this user.
bool is_own(const fs::path& path, const Descriptor& folder) {
  constexpr std::size_t drawn = 6;  // letters
  struct stat status {};
  return path.filename().string().size() == name_begin.size() + drawn &&
         ::fstat(folder.get(), &status) == 0 && status.st_uid == ::geteuid() &&
         (status.st_mode & 0777U) == 0700U;
}

bool is_gone(const Descriptor& folder) {
  struct stat status {};
  return ::fstat(folder.get(), &status) != 0 || status.st_nlink == 0;
}

/// Of checks that were killed, and whatever watched them too.
void remove_left_over(const fs::path& in) {
  std::error_code error, ignored;
  fs::directory_iterator entry(in, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    if (!entry->path().filename().string().starts_with(name_begin)) continue;
    const Descriptor folder = opened(entry->path());
    if (folder.is_open() && is_own(entry->path(), folder) && is_unlocked(folder))
      fs::remove_all(entry->path(), ignored);
  }
}

}  // namespace

CaptureFolder::CaptureFolder() {
  remove_left_over(temporary_folder());
  do {
    path_ = new_temporary_folder(std::string(name_begin));
    folder_.emplace(opened(path_));
    if (!folder_->is_open() && errno != ENOENT)
      throw Failure(
          ExitCode::environment,
          fmt::format("cannot open {} ({}) free some files, or set TMPDIR to another folder",
                      path_.string(), std::strerror(errno)));
    lock(*folder_);
  } while (is_gone(*folder_));  // another check took it for left over before it was locked
}

CaptureFolder::~CaptureFolder() {
  std::error_code error;
  fs::remove_all(path_, error);
}

fs::path CaptureFolder::write(const char* ending, const std::string& bytes) {
  for (;;) {
    const std::string name = fmt::format("{}{}", ++n_, ending);
    const Descriptor file(::openat(folder_->get(), name.c_str(),
                                   O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600));
    if (!file.is_open() && errno == EEXIST) continue;
    if (file.is_open() && write_all(file.get(), bytes)) return path_ / name;
    const int reason = errno;
    remove(name);
    throw Failure(
        ExitCode::environment,
        fmt::format("cannot write {} ({}) {}", (path_ / name).string(), std::strerror(reason),
                    reason == ENOENT ? "let decoders leave the folder of captures there"
                                     : "set TMPDIR to a place that has some space"));
  }
}

void CaptureFolder::remove(const fs::path& capture) const {
  ::unlinkat(folder_->get(), capture.filename().c_str(), 0);
}

}  // namespace sim
