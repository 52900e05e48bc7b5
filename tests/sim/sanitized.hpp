#pragma once
// Whether the address sanitizer is on, under which what is tried over and over takes several times
// as long, and what it says of libraries.
#include <cstddef>
#include <cstdlib>
#include <regex>
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

/// `stderr` without what the sanitizer says of falls of the HDF5 library over a damaged file, which
/// cost a process of its own alone: the first frame is the library's, or the second, below an
/// allocation or a copy.
inline std::string without_falls_of_hdf5(std::string stderr_text) {
  static const std::regex is_its(
      "    #0 (.*/libhdf5|0x\\S+ in (malloc|calloc|realloc|free|mem\\w+|str\\w+) .*\n    #1 "
      ".*/libhdf5)");
  const std::string last = "==ABORTING\n";
  std::size_t begin = 0;
  for (auto end = stderr_text.find(last); end != std::string::npos;
       end = stderr_text.find(last, begin)) {
    end += last.size();
    if (std::regex_search(stderr_text.substr(begin, end - begin), is_its))
      stderr_text.erase(begin, end - begin);
    else
      begin = end;
  }
  return stderr_text;
}

}  // namespace sim::test
