#include "sim/serial/pseudo_terminal.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <termios.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "sim/failure.hpp"
#include "sim/serial/raw_mode.hpp"

namespace sim {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refused(const std::string& what, const std::string& why,
                          const std::string& remedy = "end programs that have some open") {
  throw Failure(ExitCode::environment, what + " (" + why + ") " + remedy);
}

Descriptor open_master() {
  Descriptor master(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  if (!master.is_open() || ::grantpt(master.get()) != 0 || ::unlockpt(master.get()) != 0)
    refused("cannot make a pseudo-terminal", std::strerror(errno));
  return master;
}

fs::path slave_of(const Descriptor& master) {
  std::array<char, 64> name{};
  if (::ptsname_r(master.get(), name.data(), name.size()) != 0)
    refused("cannot make a pseudo-terminal", std::strerror(errno));
  return name.data();
}

short state_of(const Descriptor& master) {
  pollfd one{.fd = master.get(), .events = POLLIN, .revents = 0};
  ::poll(&one, 1, 0);
  return one.revents;
}

/// The device was made after the link to it, or is gone. Its time of change is that of its making:
/// settings and bytes do not move it, only new permissions would.
bool is_gone_or_newer(const fs::path& device, const fs::path& link) {
  struct stat made {};
  struct stat linked {};
  if (::stat(device.c_str(), &made) != 0) return errno == ENOENT;
  if (::lstat(link.c_str(), &linked) != 0) return false;
  const auto order = [](const struct stat& s) {
    return std::pair(s.st_ctim.tv_sec, s.st_ctim.tv_nsec);
  };
  return order(linked) < order(made);
}

bool is_alone(const Descriptor& master) { return (state_of(master) & POLLHUP) != 0; }

}  // namespace

PseudoTerminal::PseudoTerminal(fs::path link, double baud)
    : link_(std::move(link)), baud_(baud), ours_(open_master()), theirs_(slave_of(ours_)) {
  make_new();
  make_link();
}

PseudoTerminal::~PseudoTerminal() {
  std::error_code error;
  if (fs::read_symlink(link_, error) == theirs_) fs::remove(link_, error);
}

/// Raw, whatever the last user made of it, and without bytes that it did not read.
void PseudoTerminal::make_new() const {
  const Descriptor slave(::open(theirs_.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  termios settings{};
  if (!slave.is_open() || ::tcgetattr(slave.get(), &settings) != 0)
    refused("cannot use " + theirs_.string(), std::strerror(errno));
  settings = raw_mode(settings, baud_);
  ::tcsetattr(slave.get(), TCSANOW, &settings);
  ::tcflush(slave.get(), TCIFLUSH);
}

/// By a killed process: its end is gone, or its number is now this one's or of another that was
/// made after the link.
bool PseudoTerminal::is_left_behind() const {
  std::error_code error;
  const fs::path target = fs::read_symlink(link_, error);
  if (target == theirs_) return true;
  return target.parent_path() == "/dev/pts" && is_gone_or_newer(target, link_);
}

void PseudoTerminal::make_link() const {
  std::error_code error;
  if (is_left_behind()) fs::remove(link_, error);
  fs::create_symlink(theirs_, link_, error);
  if (error == std::errc::file_exists)
    throw bad_input("cannot make the link " + name(), "something else has this name",
                    "choose another name, or remove it");
  if (error) refused("cannot make the link " + name(), error.message(), "choose another name");
}

int PseudoTerminal::descriptor() {
  if (state_of(ours_) != POLLHUP) {
    used_ = true;
    return ours_.get();
  }
  if (std::exchange(used_, false)) make_new();
  return -1;
}

protocol::Bytes PseudoTerminal::read() {
  std::array<std::uint8_t, 4096> buffer{};
  const ssize_t n = ::read(ours_.get(), buffer.data(), buffer.size());
  if (n <= 0) return {};  // nothing yet, or nobody there
  return {buffer.begin(), buffer.begin() + n};
}

std::size_t PseudoTerminal::write(std::span<const std::uint8_t> bytes) {
  if (is_alone(ours_)) return bytes.size();
  const ssize_t n = ::write(ours_.get(), bytes.data(), bytes.size());
  return n < 0 ? 0 : static_cast<std::size_t>(n);
}

}  // namespace sim
