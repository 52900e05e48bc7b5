#pragma once
// A run of an experiment that is not a link: what it is given by the command.
#include <atomic>
#include <filesystem>
#include <string>

#include "sim/program_info.hpp"
#include "sim/scenario.hpp"

namespace sim {

struct ExperimentRun {
  const LoadedScenario& scenario;
  std::filesystem::path output;
  std::string command;  // as the user typed it
  ProgramInfo program;
  int threads = 1;
  bool json = false;
  const std::atomic<bool>* interrupt = nullptr;

  bool interrupted() const { return interrupt != nullptr && *interrupt; }
};

}  // namespace sim
