#pragma once
// A run of an experiment: what it is given by the command, and what the commands ask of an
// experiment, whatever its points are.
#include <cstdint>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "sim/columns/column.hpp"
#include "sim/engine/process_group.hpp"
#include "sim/program_info.hpp"
#include "sim/result/dataset.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/threads/parallel_runs.hpp"

namespace sim {

struct ExperimentRun {
  LoadedScenario scenario;
  std::filesystem::path output;
  std::string command;  // as the user typed it
  ProgramInfo program;
  Workers workers{};
  ProcessGroup* processes =
      nullptr;  // each of whose members runs the same; the first speaks for all
  bool json = false, quiet = false, table = false, plot = false, profile = false;
  /// Results of the same scenario, program and shards, whose counts it goes on with or adds up.
  std::vector<std::filesystem::path> counted_in{};
  std::vector<Shard> shards{{}};
  bool counts_nothing = false;  // what was counted before is all: shards are merged

  bool speaks() const { return processes == nullptr || processes->rank() == 0; }
};

enum class RunEnd {
  finished,    // all points
  unfinished,  // what was counted is kept
  nothing      // nothing was counted, and the file is as it was
};

/// A run before its first trial: what it goes on with is read, what can be refused is refused.
class ReadyRun {
 public:
  ReadyRun() = default;
  ReadyRun(const ReadyRun&) = delete;
  ReadyRun& operator=(const ReadyRun&) = delete;
  virtual ~ReadyRun() = default;

  /// What it starts from, for the members of a process group to compare.
  virtual std::string start() const = 0;
  /// Runs, says and writes.
  virtual RunEnd operator()() = 0;
};

/// What the commands ask of an experiment, whatever its points are. All throw Failure.
struct ExperimentEngine {
  std::unique_ptr<ReadyRun> (*ready)(ExperimentRun);
  /// Throws where a point cannot be shared out like this.
  void (*check_shard)(const LoadedScenario&, const Shard&);
  /// The table of what each point of a shard would take; of fewer points if interrupted.
  std::string (*plan)(const LoadedScenario&, const Shard&, const Workers&);
  /// How much of amount_key() each point may have for all to take so many seconds.
  std::uint64_t (*amount_within)(const LoadedScenario&, double seconds, const Workers&);
  /// Of its results.
  std::vector<ColumnFacts> (*columns)();
};

/// Into how many characters a row is to fit; 0: into any.
int room_of_rows(const ExperimentRun& run);

/// Whether a terminal is spared the rows: it would show the last of them alone.
bool are_too_many_rows(const ExperimentRun& run, std::size_t points);

/// Prints rows of points while they are measured; nothing as JSON. Where they cannot be printed any
/// more, what is measured is not given up: the failure waits for the result to be written.
class Rows {
 public:
  explicit Rows(bool silent) : silent_(silent) {}
  void print(const std::string& text);
  bool have_failed() const { return failure_ != nullptr; }
  bool are_silent() const { return silent_; }
  /// Throws what print could not.
  void check() const;

 private:
  bool silent_;
  std::exception_ptr failure_;
};

/// That an interrupt came before anything was counted.
void say_left_as_it_was(const ExperimentRun& run);

/// What is printed of a result behind the rows of its points.
struct ResultTexts {
  std::function<std::string()> json;
  std::function<std::string()> plots;  // if they are asked for
  std::string missing;                 // what was not counted
  std::string overview;                // in place of rows that a terminal was spared
  std::function<std::string()> notes, details;
};

/// Writes a result and says what is in it: as JSON, or by the other texts and the digest. The texts
/// are made when it is written. A run that counted nothing leaves the file as it was.
void conclude(const ExperimentRun& run, const Rows& rows, const Dataset& data,
              const ResultTexts& texts);

}  // namespace sim
