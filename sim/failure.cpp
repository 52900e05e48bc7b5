#include "sim/failure.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sim/spelling.hpp"

namespace sim {
namespace {

bool is_control(char c) { return (c >= 0 && c < ' ') || c == '\x7f'; }

std::size_t unlikeness(const std::string& name, const std::string& candidate) {
  const std::size_t dot = candidate.find('.');
  if (dot == std::string::npos) return slips(name, candidate);
  return std::min(slips(name, candidate), 1 + slips(name, candidate.substr(dot + 1)));
}

}  // namespace

Failure bad_input(const std::string& problem, const std::string& why,
                  const std::string& suggestion) {
  std::string line = fmt::format("{} ({}) {}", problem, why, suggestion);
  std::ranges::replace_if(line, is_control, '?');
  return {ExitCode::bad_input, line};
}

std::string nearest(const std::string& name, const std::vector<std::string>& candidates) {
  const auto likeness = [&](const std::string& c) { return unlikeness(name, c); };
  const auto best = std::ranges::min_element(candidates, {}, likeness);
  return best == candidates.end() ? "" : *best;
}

}  // namespace sim
