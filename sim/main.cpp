// The program: what it knows of itself, and one call. Whatever goes wrong below is caught here,
// once, and said in one line.
#include <exception>
#include <filesystem>
#include <iostream>
#include <string>

#include "sim/command_line.hpp"
#include "sim/failure.hpp"

namespace {

namespace fs = std::filesystem;

/// The program's own parts, in the build tree as where it is installed.
fs::path shipped_parts() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  return program.parent_path().parent_path() / "share" / "cosys-sim";
}

std::string quoted(const std::string& argument) {
  if (!argument.empty() &&
      argument.find_first_of(" \t\n\"'\\$`*?[]{}()<>|&;#~!") == std::string::npos)
    return argument;
  std::string text = "'";
  for (const char c : argument) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

std::string typed_command(int argc, char** argv) {
  std::string text = "cosys-sim";
  for (int i = 1; i < argc; ++i) text += " " + quoted(argv[i]);
  return text;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return sim::run_command_line(argc, argv,
                                 {.program = {"cosys-sim", COSYS_VERSION, COSYS_COMMIT},
                                  .command = typed_command(argc, argv),
                                  .shipped_parts = shipped_parts()});
  } catch (const sim::Failure& e) {
    std::cerr << "cosys-sim: " << e.what() << "\n";
    return static_cast<int>(e.code());
  } catch (const std::exception& e) {
    std::cerr << "cosys-sim: " << e.what() << " (the machine refused) free memory or disk\n";
    return static_cast<int>(sim::ExitCode::environment);
  }
}
