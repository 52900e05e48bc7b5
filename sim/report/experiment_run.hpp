#pragma once
// A run of an experiment that is not a link: what it is given by the command.
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "sim/engine/measurement.hpp"
#include "sim/engine/process_group.hpp"
#include "sim/program_info.hpp"
#include "sim/result/dataset.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/section/dataset_charts.hpp"
#include "sim/threads/parallel_runs.hpp"

namespace sim {

struct ExperimentRun {
  const LoadedScenario& scenario;
  std::filesystem::path output;
  std::string command;  // as the user typed it
  ProgramInfo program;
  Workers workers{};
  ProcessGroup* processes =
      nullptr;  // each of whose members runs the same; the first speaks for all
  bool json = false, quiet = false, plot = false;
  /// What was counted before, by files of the same scenario; the runs that the result has.
  std::vector<std::string> checkpoints{};
  std::vector<Shard> shards{{}};
  bool counts_nothing = false;  // what was counted before is all: shards are merged

  bool speaks() const { return processes == nullptr || processes->rank() == 0; }
};

/// What the commands ask of an experiment, whatever its points are.
struct ExperimentEngine {
  /// Whether all points have all of their runs.
  bool (*run)(const ExperimentRun&);
  /// One for each point, for a shard; fewer if interrupted.
  std::vector<RunPilot> (*pilots)(const LoadedScenario&, const Shard&, const Workers&);
  /// Of its results.
  std::vector<ColumnFacts> (*columns)();
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

/// That an interrupt came before anything was counted.
void say_left_as_it_was(const ExperimentRun& run);

/// Writes a result and says what is in it: as JSON; or, behind the rows of its points, curves if
/// they are asked for, what is `missing`, notes, `details` and the digest. Where an interrupt came
/// before anything was measured, the file stays as it was.
void conclude(const ExperimentRun& run, const Rows& rows, const Dataset& data,
              const std::string& missing, const std::vector<DrawnVariable>& drawn,
              const std::string& details);

}  // namespace sim
