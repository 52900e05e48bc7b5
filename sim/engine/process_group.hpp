#pragma once
// A process group: the processes of one MPI job (`mpirun -n 8 cosys-sim run ...`), which share out
// the trials of each point. All of them walk through the same calls in the same order and hold the
// same sums, so there is no master; the first of them prints and writes for all.
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace sim {

class ProcessGroup {
 public:
  virtual ~ProcessGroup() = default;

  virtual int size() const = 0;
  virtual int rank() const = 0;  // 0: the one that speaks

  /// The bytes that all members give, 2 GB in all: those of the first, of the second, ...
  virtual std::vector<std::string> exchange(const std::string& mine) = 0;
  /// Whether it is true for any member.
  virtual bool any(bool mine) = 0;
  /// All members are about to end, some of them by a failure; waits until all have said so. One
  /// that fails without that ends the whole job at once.
  virtual void end_in_order() = 0;
  /// The largest of all members' numbers.
  virtual double largest(double mine) = 0;
};

/// Does a step that may fail: true if no member failed. If any did, the first of them throws its
/// Failure and the others give false; all of them then have to end, the others as if all were well:
/// a job is over once a member has ended badly, said or not. Alone: simply the step.
bool collective(ProcessGroup* processes, const std::function<void()>& step);

/// How much each member is to do before the next exchange, as what it did last took `seconds`: the
/// members wait for the slowest, so long against that, but a user who interrupts waits too. Between
/// `least` and `most`.
std::uint64_t next_share(std::uint64_t share, double seconds, std::uint64_t least,
                         std::uint64_t most);

/// Whether all hold the same text; if not, the first throws Failure(environment), as in
/// collective().
bool agree(ProcessGroup* processes, const std::string& text);

/// The job that this process was started in; null if it is alone, or built without MPI.
std::unique_ptr<ProcessGroup> join_process_group();

}  // namespace sim
