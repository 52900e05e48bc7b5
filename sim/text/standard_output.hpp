#pragma once
// stdout carries results, all of them or an error: a full disk behind a redirection is not silent.
// stderr carries words about them.
#include <cstdio>
#include <string_view>

#include "sim/failure.hpp"

namespace sim {

inline Failure unwritable_output() {
  return {ExitCode::environment,
          "cannot write to standard output (it is closed or full) redirect it elsewhere"};
}

inline void print(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
    throw unwritable_output();
}

/// Nothing is lost if this cannot be written, so nobody is told.
inline void say(std::string_view text) { std::fwrite(text.data(), 1, text.size(), stderr); }

}  // namespace sim
