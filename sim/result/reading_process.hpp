#pragma once
// A process of its own that reads one HDF5 file and answers questions about it. If the library
// falls over a damaged file, never comes back, or wants all memory, then that process is gone and
// we are not. It has 1 s of processor time, and more as it answers; 640 MB of memory; and 6 s for
// an answer. Start one while no thread is about that throws, or that uses HDF5; it ends with the
// thread that starts it.
#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>

#include "sim/result/hdf5_question.hpp"

namespace sim {

class ReadingProcess {
 public:
  /// Throws Failure(environment) where the machine starts no more processes.
  explicit ReadingProcess(const std::filesystem::path& path);
  ReadingProcess(const ReadingProcess&) = delete;
  ReadingProcess& operator=(const ReadingProcess&) = delete;
  ~ReadingProcess();

  /// The answer, as Asked says; none where the library refuses the file or has no such thing.
  /// Throws Failure(bad_input), naming the file, where the process ended instead.
  std::optional<std::string> ask(const Question& question);

 private:
  enum class Received { all, end, nothing };

  Received receive(void* to, std::size_t bytes) const;
  [[noreturn]] void give_up(Received last);
  int wait_for_end();

  std::string path_;
  int socket_ = -1;
  pid_t child_ = -1;
  std::string fault_;  // why it is gone
};

}  // namespace sim
