#pragma once
// A run of an experiment that is not a link: what it is given by the command.
#include <atomic>
#include <filesystem>
#include <string>

#include "sim/dataset.hpp"
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

/// Writes a result and says what is in it: as JSON; or, behind the rows of its points, notes, what
/// more there is to say (`details`) and the digest. Where an interrupt came before anything was
/// measured, the file stays as it was.
void conclude(const ExperimentRun& run, const Dataset& data, const std::string& details = "");

/// The same where there are no points at all.
void conclude_without_points(const ExperimentRun& run);

}  // namespace sim
