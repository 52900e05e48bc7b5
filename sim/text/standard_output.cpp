#include "sim/text/standard_output.hpp"

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

std::string shown(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    const bool is_c1 = i + 1 < text.size() && is_obeyed(c, static_cast<unsigned char>(text[i + 1]));
    result += is_c1 || is_obeyed(c) ? '?' : text[i];
    i += is_c1;
  }
  return result;
}

}  // namespace

Failure unwritable_output(int error) {
  if (error == EPIPE) return {ExitCode::reader_gone, "the reader of standard output is gone"};
  return {ExitCode::environment,
          "cannot write to standard output (it is closed or full) redirect it elsewhere"};
}

void print(std::string_view text) { print_bytes(shown(text)); }

void print_bytes(std::string_view bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size() ||
      std::fflush(stdout) != 0)
    throw unwritable_output(errno);
}

void say(std::string_view text) { draw(shown(text)); }

void draw(std::string_view text) { std::fwrite(text.data(), 1, text.size(), stderr); }

}  // namespace sim
