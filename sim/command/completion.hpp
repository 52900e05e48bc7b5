#pragma once
// Scripts by which a shell completes a command line of the program: commands, options, words of a
// choice, keys of a scenario, names of the shipped parts, files by their ending. None asks the
// program, nor needs packages of the shell's.
#include <string>

#include "sim/command/usage.hpp"

namespace sim {

/// To be sourced, or named cosys-sim in a folder that bash-completion reads.
std::string bash_completion(const ProgramUsage& usage);

/// To be named _cosys-sim in a folder of zsh's fpath.
std::string zsh_completion(const ProgramUsage& usage);

/// To be sourced, or named cosys-sim.fish in a folder of fish_complete_path.
std::string fish_completion(const ProgramUsage& usage);

}  // namespace sim
