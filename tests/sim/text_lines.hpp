#pragma once
// A text by its lines.
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace sim {

/// Without their ends.
inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// The last line, with the end that it has.
inline std::string last_line(const std::string& text) {
  const std::size_t end = text.rfind('\n', text.size() - 2);
  return text.substr(end == std::string::npos ? 0 : end + 1);
}

/// The first line that has a part in it; empty if none has.
inline std::string first_line_with(const std::string& text, const std::string& part) {
  for (std::string& line : lines_of(text))
    if (line.find(part) != std::string::npos) return std::move(line);
  return "";
}

}  // namespace sim
