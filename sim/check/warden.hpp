#pragma once
// Warden: a process of ours that waits for this program to end. However that happens, by kill -9
// too, it then ends the programs of users that were under way, what these have started, and removes
// the folder of their captures.
#include <sys/types.h>

#include <atomic>
#include <filesystem>
#include <string>

#include "sim/failure.hpp"
#include "sim/serial/descriptor.hpp"

namespace sim {

/// Why the machine starts no more processes, by its errno.
Failure no_more_processes(int error);

class Warden {
 public:
  /// `folder` may be empty. Throws Failure(environment) where the machine starts no more processes.
  explicit Warden(const std::filesystem::path& folder);
  Warden(const Warden&) = delete;
  Warden& operator=(const Warden&) = delete;
  /// Ends what programs left behind.
  ~Warden();

  /// What marks begin with.
  static constexpr const char* mark_name = "COSYS_SIM_DECODER=";
  /// A setting for the environment of a program that is to be watched, NAME=VALUE. By it processes
  /// are found that left their group. From any thread.
  std::string next_mark() const;
  /// A program begins, in a group of processes of its own; from any thread.
  void begin(pid_t group) const { tell(group); }
  /// It is killed, but not yet waited for, so that its number is nobody else's.
  void end(pid_t group) const { tell(-group); }
  /// Kills all that has such a mark.
  void end_marked(const std::string& mark) const;

 private:
  void tell(pid_t group) const;

  std::string mark_;  // that of its programs begins so
  mutable std::atomic<int> programs_ = 0;
  pid_t process_ = -1;
  Descriptor to_;
};

}  // namespace sim
