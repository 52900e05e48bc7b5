#include "sim/serial/line_input.hpp"

#include <unistd.h>

#include <array>
#include <cerrno>
#include <utility>

namespace sim {

std::vector<std::string> LineInput::read() {
  std::array<char, 4096> buffer{};
  std::vector<std::string> lines;
  const ssize_t n = ::read(descriptor_, buffer.data(), buffer.size());
  if (n < 0 && (errno == EAGAIN || errno == EINTR)) return lines;
  for (ssize_t i = 0; i < n; ++i) take(buffer[static_cast<std::size_t>(i)], lines);
  if (n > 0) return lines;
  descriptor_ = -1;
  if (!begun_.empty()) end_line(lines);
  return lines;
}

void LineInput::take(char c, std::vector<std::string>& lines) {
  if (c == '\n')
    end_line(lines);
  else if (begun_.size() <= longest_)
    begun_ += c;
}

void LineInput::end_line(std::vector<std::string>& lines) {
  if (begun_.ends_with('\r')) begun_.pop_back();
  lines.push_back(std::exchange(begun_, {}));
}

}  // namespace sim
