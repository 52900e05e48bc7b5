#include "sim/text/text_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>

#include "sim/failure.hpp"

namespace sim {
namespace {

namespace fs = std::filesystem;

/// A file open for reading, without waiting for the other end of a pipe to be opened.
class File {
 public:
  explicit File(const fs::path& path) : number_(::open(path.c_str(), mode)) {}
  ~File() {
    if (number_ >= 0) ::close(number_);
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  /// Bytes read, waiting for at least one; 0 at the end, below 0 if it cannot be read.
  ssize_t read(char* to, std::size_t size) const {
    for (;;) {
      const ssize_t n = ::read(number_, to, size);
      if (n >= 0 || (errno != EAGAIN && errno != EINTR)) return n;
      pollfd wait{number_, POLLIN, 0};
      ::poll(&wait, 1, -1);
    }
  }

 private:
  static constexpr int mode = O_RDONLY | O_NONBLOCK | O_CLOEXEC;
  int number_;
};

Failure too_long(const std::string& name, const std::string& what, std::size_t longest) {
  return bad_input(name, fmt::format("longer than {} MiB", longest / mebibyte),
                   "shorten it or name a " + what + " file");
}

std::string read_all(const fs::path& path, const std::string& what, std::size_t longest) {
  const std::string name = path.generic_string();
  const File file(path);
  std::array<char, 65536> chunk;
  std::string text;
  for (;;) {
    const ssize_t n = file.read(chunk.data(), chunk.size());
    if (n < 0) throw bad_input(name, "cannot be read", "check its permissions");
    if (n == 0) return text;
    text.append(chunk.data(), static_cast<std::size_t>(n));
    if (text.size() > longest) throw too_long(name, what, longest);
  }
}

}  // namespace

std::string read_text_file(const fs::path& path, const std::string& what, std::size_t longest) {
  const std::string name = path.generic_string();
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  if (fs::is_directory(status))
    throw bad_input(name, "a folder, not a " + what + " file", "name a file in it");
  if (!fs::exists(status)) throw bad_input(name, "no such file", "check the path");
  if (fs::is_regular_file(status) && fs::file_size(path, ignored) > longest)
    throw too_long(name, what, longest);
  std::string text = read_all(path, what, longest);
  if (text.empty() && fs::is_fifo(status))
    throw bad_input(name, "a pipe that nothing is written to", "start its writer first");
  return text;
}

}  // namespace sim
