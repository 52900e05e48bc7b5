#pragma once
// Whether the address sanitizer is on, under which what is tried over and over takes several times
// as long.
#include <cstddef>
#include <cstdlib>
#include <sstream>
#include <string>
#include <string_view>

namespace sim::test {

#if defined(__SANITIZE_ADDRESS__)
inline constexpr bool is_sanitized = true;
#elif defined(__has_feature)
inline constexpr bool is_sanitized = __has_feature(address_sanitizer);
#else
inline constexpr bool is_sanitized = false;
#endif

/// Whether a variable of the gate's, as COSYS_WEEKLY, is set to 1.
inline bool is_set(const char* variable) {
  const char* const value = std::getenv(variable);
  return value != nullptr && std::string_view(value) == "1";
}

/// One try of how many is made: of each, but of `n` under the sanitizer where the run is not the
/// weekly one.
inline std::size_t one_of(std::size_t n) { return is_sanitized && !is_set("COSYS_WEEKLY") ? n : 1; }

/// `stderr` without lines that say of a damaged size that there is no memory for it: malloc then
/// gives none, as everywhere.
inline std::string without_refused_sizes(const std::string& stderr_text) {
  std::istringstream lines(stderr_text);
  std::string rest;
  for (std::string line; std::getline(lines, line);)
    if (line.find("WARNING: AddressSanitizer failed to allocate") == std::string::npos)
      rest += line + '\n';
  return rest;
}

}  // namespace sim::test
