#include "sim/text/standard_output.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <string>

namespace sim {
namespace {

bool is_obeyed(unsigned char c) { return (c < ' ' && c != '\n' && c != '\t') || c == 0x7f; }

/// C1 as UTF-8: U+0080 to U+009F.
bool is_obeyed(unsigned char first, unsigned char second) {
  return first == 0xc2 && second >= 0x80 && second <= 0x9f;
}

/// The text with all of these characters written by `as`.
template <class Written>
std::string without_obeyed(std::string_view text, const Written& as) {
  std::string result;
  result.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    const auto next = static_cast<unsigned char>(i + 1 < text.size() ? text[i + 1] : 0);
    if (is_obeyed(c, next)) {
      result += as(next);
      ++i;
    } else if (is_obeyed(c)) {
      result += as(c);
    } else {
      result += text[i];
    }
  }
  return result;
}

std::string shown(std::string_view text) {
  return without_obeyed(text, [](unsigned char) { return "?"; });
}

}  // namespace

Failure unwritable_output(int error) {
  if (error == EPIPE) return {ExitCode::reader_gone, "the reader of standard output is gone"};
  return {ExitCode::environment,
          "cannot write to standard output (it is closed or full) redirect it elsewhere"};
}

void print(std::string_view text) { print_bytes(shown(text)); }

void print_json(std::string_view text) {
  print_bytes(without_obeyed(text, [](unsigned code) { return fmt::format("\\u{:04x}", code); }));
}

void print_bytes(std::string_view bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size() ||
      std::fflush(stdout) != 0)
    throw unwritable_output(errno);
}

void say(std::string_view text) { draw(shown(text)); }

void draw(std::string_view text) { std::fwrite(text.data(), 1, text.size(), stderr); }

bool is_terminal() { return ::isatty(STDOUT_FILENO) == 1; }

int terminal_columns() {
  winsize size{};
  return ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

}  // namespace sim
