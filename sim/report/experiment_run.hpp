#pragma once
// A run of an experiment that is not a link: what it is given by the command.
#include <exception>
#include <filesystem>
#include <string>

#include "sim/program_info.hpp"
#include "sim/result/dataset.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/threads/run_sharing.hpp"

namespace sim {

struct ExperimentRun {
  const LoadedScenario& scenario;
  std::filesystem::path output;
  std::string command;  // as the user typed it
  ProgramInfo program;
  Workers workers{};
  bool json = false;
};

/// Prints rows of points while they are measured; nothing as JSON. Where they cannot be printed any
/// more, what is measured is not given up: the failure waits for the result to be written.
class Rows {
 public:
  explicit Rows(bool silent) : silent_(silent) {}
  void print(const std::string& text);
  /// Throws what print could not.
  void check() const;

 private:
  bool silent_;
  std::exception_ptr failure_;
};

/// Writes a result and says what is in it: as JSON; or, behind the rows of its points, notes, what
/// more there is to say (`details`) and the digest. Where an interrupt came before anything was
/// measured, the file stays as it was.
void conclude(const ExperimentRun& run, const Rows& rows, const Dataset& data,
              const std::string& details = "");

/// The same where there are no points at all.
void conclude_without_points(const ExperimentRun& run);

}  // namespace sim
