#pragma once
// Whether the address sanitizer is on, under which what is tried over and over takes several times
// as long.
#include <cstddef>
#include <cstdlib>

namespace sim::test {

#if defined(__SANITIZE_ADDRESS__)
inline constexpr bool is_sanitized = true;
#elif defined(__has_feature)
inline constexpr bool is_sanitized = __has_feature(address_sanitizer);
#else
inline constexpr bool is_sanitized = false;
#endif

/// Of how many tries one is made: all in the release build and once a week (COSYS_WEEKLY), else one
/// of `n`.
inline std::size_t one_of(std::size_t n) {
  return is_sanitized && std::getenv("COSYS_WEEKLY") == nullptr ? n : 1;
}

}  // namespace sim::test
