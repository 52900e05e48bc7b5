#include "sim/failure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace sim {
namespace {

bool is_control(char c) { return (c >= 0 && c < ' ') || c == '\x7f'; }

std::string on_one_line(std::string text) {
  std::ranges::replace_if(text, is_control, '?');
  return text;
}

}  // namespace

Failure::Failure(ExitCode code, std::string message)
    : std::runtime_error(on_one_line(std::move(message))), code_(code) {}

Failure bad_input(const std::string& problem, const std::string& why,
                  const std::string& suggestion) {
  return {ExitCode::bad_input, fmt::format("{} ({}) {}", problem, why, suggestion)};
}

}  // namespace sim
