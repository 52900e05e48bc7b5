#pragma once
// NewFile: a file written beside its place, which takes that place only when it is complete and on
// the disk; until then what was there stays, and a writer that gives up leaves nothing behind.
#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

#include "sim/failure.hpp"

namespace sim {

class NewFile {
 public:
  explicit NewFile(const std::filesystem::path& place)
      : place_(resolved(place)),
        beside_(place_.string() + "." + std::to_string(getpid()) + ".tmp") {
    refuse_what_is_no_file();
    descriptor_ = ::open(beside_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (descriptor_ < 0) fail();
  }
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;
  ~NewFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!in_place_) ::unlink(beside_.c_str());
  }

  void write(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t n = ::write(descriptor_, bytes.data(), bytes.size());
      if (n < 0 && errno != EINTR) fail();
      if (n > 0) bytes.remove_prefix(static_cast<std::size_t>(n));
    }
  }

  void take_place() {
    if (::fsync(descriptor_) != 0) fail();
    if (::rename(beside_.c_str(), place_.c_str()) != 0) fail();
    in_place_ = true;
  }

 private:
  using Path = std::filesystem::path;

  // A link is written through, not replaced.
  static Path resolved(const Path& place) {
    std::error_code error;
    const Path target = std::filesystem::canonical(place, error);
    return error ? place : target;
  }

  void refuse_what_is_no_file() const {
    std::error_code error;
    const auto status = std::filesystem::status(place_, error);
    if (is_directory(status)) fail("it is a folder", "add a file name");
    if (exists(status) && !is_regular_file(status)) fail("it is not a regular file", other_place);
  }

  [[noreturn]] void fail() const {
    const int reason = errno;
    if (reason == ENOENT) fail("its folder does not exist", "create the folder or choose another");
    const std::string why = std::generic_category().message(reason);
    fail(why.c_str(),
         reason == ENOSPC ? "free some space there or choose another place" : other_place);
  }

  [[noreturn]] void fail(const char* why, const char* suggestion) const {
    throw Failure(ExitCode::environment,
                  "cannot write " + place_.string() + " (" + why + ") " + suggestion);
  }

  static constexpr const char* other_place = "choose another place";

  Path place_, beside_;
  int descriptor_ = -1;
  bool in_place_ = false;
};

}  // namespace sim
