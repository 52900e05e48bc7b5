#include "sim/failure.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace sim {
namespace {

bool is_control(char c) { return (c >= 0 && c < ' ') || c == '\x7f'; }

}  // namespace

Failure bad_input(const std::string& problem, const std::string& why,
                  const std::string& suggestion) {
  std::string line = fmt::format("{} ({}) {}", problem, why, suggestion);
  std::ranges::replace_if(line, is_control, '?');
  return {ExitCode::bad_input, line};
}

}  // namespace sim
