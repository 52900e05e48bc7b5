#include "sim/text/write_all.hpp"

#include <poll.h>
#include <unistd.h>

#include <cerrno>

namespace sim {
namespace {

bool is_for_later(int descriptor) {
  if (errno == EINTR) return true;
  if (errno != EAGAIN) return false;
  pollfd one{.fd = descriptor, .events = POLLOUT, .revents = 0};
  ::poll(&one, 1, -1);
  return true;
}

}  // namespace

bool write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(descriptor, bytes.data(), bytes.size());
    if (n < 0 && !is_for_later(descriptor)) return false;
    if (n > 0) bytes.remove_prefix(static_cast<std::size_t>(n));
  }
  return true;
}

}  // namespace sim
