#pragma once
// The main function of the programs here: words in, an exit code out.
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <functional>
#include <string>
#include <vector>

namespace hidden {

/// Runs it with the words behind the program's name, at least four of them.
inline int program_of(int argc, char** argv, const char* usage,
                      const std::function<void(const std::vector<std::string>&)>& run) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (words.size() < 4) {
    std::fputs(usage, stderr);
    return 2;
  }
  try {
    run(words);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}: {}\n", argv[0], error.what());
    return 1;
  }
  return 0;
}

}  // namespace hidden
