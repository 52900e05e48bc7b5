#pragma once
// The command line: options in, one call of a command, its exit code out.
#include <filesystem>
#include <string>

#include "sim/program_info.hpp"

namespace sim {

/// What the program knows of itself when it starts.
struct Surroundings {
  ProgramInfo program;
  std::string commit_date;              // "2024-05-31"; empty where there is no git
  std::string command;                  // as the user typed it
  std::filesystem::path shipped_parts;  // the folder with the program's own modules/ and leds/
};

/// Throws Failure(bad_input), one line, for what cannot be read; --help and --version go to stdout.
int run_command_line(int argc, char** argv, const Surroundings& surroundings);

}  // namespace sim
