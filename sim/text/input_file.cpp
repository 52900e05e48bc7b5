#include "sim/text/input_file.hpp"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>

#include "sim/failure.hpp"
#include "sim/text/standard_output.hpp"

namespace sim {

namespace fs = std::filesystem;

void refuse_no_file(const fs::path& path, const std::string& what) {
  const std::string name = path.generic_string();
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  if (fs::is_directory(status))
    throw bad_input(name, "a folder, not a " + what + " file", "name a file in it");
  if (!fs::exists(status)) throw bad_input(name, "no such file", "check the path");
}

InputFile::InputFile(const fs::path& path)
    : name_(path.generic_string()),
      number_(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)) {}

InputFile::~InputFile() {
  if (number_ >= 0) ::close(number_);
}

std::size_t InputFile::read(char* to, std::size_t size) {
  constexpr int patience_ms = 5000;
  for (;;) {
    const ssize_t n = ::read(number_, to, size);
    if (n >= 0) return static_cast<std::size_t>(n);
    if (errno != EAGAIN && errno != EINTR)
      throw bad_input(name_, "cannot be read", "check its permissions");
    pollfd wait{number_, POLLIN, 0};
    if (::poll(&wait, 1, patience_ms) != 0 || told_) continue;
    told_ = true;
    say("cosys-sim: waiting for " + name_ + " (a pipe or device, and nothing has come for 5 s)\n");
  }
}

InputStream::InputStream(const fs::path& path, const std::string& what)
    : std::istream(nullptr), bytes_((refuse_no_file(path, what), path)) {
  rdbuf(&bytes_);
}

/// A pipe gives what was written so far, which may be one byte.
std::string_view InputStream::Bytes::at_hand() {
  constexpr std::ptrdiff_t enough = 16;
  if (gptr() == egptr()) setg(chunk_.data(), chunk_.data(), chunk_.data());
  for (std::size_t n = 1; n > 0 && egptr() - gptr() < enough;) {
    n = file_.read(egptr(), static_cast<std::size_t>(chunk_.data() + chunk_.size() - egptr()));
    setg(eback(), gptr(), egptr() + n);
  }
  return {gptr(), egptr()};
}

InputStream::Bytes::int_type InputStream::Bytes::underflow() {
  const std::size_t n = file_.read(chunk_.data(), chunk_.size());
  setg(chunk_.data(), chunk_.data(), chunk_.data() + n);
  return n == 0 ? traits_type::eof() : traits_type::to_int_type(chunk_.front());
}

}  // namespace sim
