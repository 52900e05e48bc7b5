#pragma once
// Somebody's program under way: a shell command that is given bytes and whose output is read as it
// comes, so that neither waits for the other for ever. It is in a process group of its own, which
// is killed with it; a warden, where there is one, ends what has left that group.
#include <sys/types.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "sim/check/warden.hpp"
#include "sim/serial/descriptor.hpp"

namespace sim {

/// Why a task is over.
enum class Waited { done, ended, timeout, stopped, too_much };

struct ChildTask {
  std::string_view input;  // for its stdin
  bool close = true;       // its stdin behind that
  /// Whether it has printed all that is wanted; without one it goes on until it has ended.
  std::function<bool(const std::string&)> is_complete{};
  std::size_t most_output = std::size_t{64} << 20U;
  std::chrono::duration<double> timeout{60};
  const std::atomic<bool>* stop = nullptr;
};

class ChildProcess {
 public:
  /// Throws Failure(environment) where the machine starts no more processes.
  explicit ChildProcess(const std::string& command, const Warden* warden = nullptr);
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  ~ChildProcess();

  /// Appends what it prints to `output`; not much more than `most_output`.
  Waited run(ChildTask task, std::string& output);

  /// The end of its stdin.
  void close_input() { in_.reset(); }

  /// As of waitpid, once run() said that it has ended.
  int status() const { return status_; }
  /// The end of what it said on stderr.
  const std::string& words() const { return words_; }

 private:
  void start(const std::string& command, const int (&ends)[3]);
  bool serve(ChildTask& task, std::string& output);
  void write_some(std::string_view& input);
  void read_words();
  void end(const ChildTask& task, std::string& output);
  void kill_all();

  const Warden* warden_;
  const std::string mark_;  // in its environment, for the warden; or empty
  pid_t pid_ = -1;
  std::optional<Descriptor> process_, in_, out_, err_;
  int status_ = 0;
  std::string words_;
};

}  // namespace sim
