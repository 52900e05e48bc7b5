#include "sim/check/child_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/syscall.h>
#include <sys/wait.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>
#include <vector>

namespace sim {
namespace {

constexpr std::size_t most_words = 4096;
constexpr int pause_ms = 50;  // between looks at whether all shall stop

/// Ours does not wait; theirs is an end like any other.
struct Pipe {
  Descriptor ours, theirs;

  static Pipe make(bool we_write) {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) throw no_more_processes(errno);
    Pipe pipe{Descriptor(ends[we_write ? 1 : 0]), Descriptor(ends[we_write ? 0 : 1])};
    ::fcntl(pipe.ours.get(), F_SETFL, O_NONBLOCK);
    return pipe;
  }
};

/// Appends what is there, up to more than `most`; false at the end of all.
bool read_some(int from, std::string& to, std::size_t most) {
  std::array<char, 65536> chunk;
  for (;;) {
    const ssize_t n = ::read(from, chunk.data(), chunk.size());
    if (n < 0) return errno == EAGAIN || errno == EINTR;
    if (n == 0) return false;
    to.append(chunk.data(), static_cast<std::size_t>(n));
    if (to.size() > most) return true;
  }
}

pollfd wait_for(const std::optional<Descriptor>& descriptor, short event) {
  return {.fd = descriptor ? descriptor->get() : -1, .events = event, .revents = 0};
}

/// Ours with another mark, or as it is where there is none: of two a shell keeps the last.
std::vector<char*> environment_with(const std::string& setting) {
  std::vector<char*> all;
  if (!setting.empty()) all.push_back(const_cast<char*>(setting.c_str()));
  for (char** one = environ; *one != nullptr; ++one)
    if (setting.empty() || !std::string_view(*one).starts_with(Warden::mark_name))
      all.push_back(*one);
  all.push_back(nullptr);
  return all;
}

}  // namespace

ChildProcess::ChildProcess(const std::string& command, const Warden* warden)
    : warden_(warden), mark_(warden == nullptr ? "" : warden->next_mark()) {
  Pipe in = Pipe::make(true), out = Pipe::make(false), err = Pipe::make(false);
  start(command, {in.theirs.get(), out.theirs.get(), err.theirs.get()});
  in_.emplace(std::move(in.ours));
  out_.emplace(std::move(out.ours));
  err_.emplace(std::move(err.ours));
}

ChildProcess::~ChildProcess() {
  if (pid_ < 0) return;
  kill_all();
  if (warden_ != nullptr) warden_->end_marked(mark_);  // it did not end by itself
}

/// It, if it has not ended, and what it left behind: its number is its group's until it is waited
/// for.
void ChildProcess::kill_all() {
  ::kill(-pid_, SIGKILL);
  if (warden_ != nullptr) warden_->end(pid_);
  ::waitpid(std::exchange(pid_, -1), &status_, 0);
}

void ChildProcess::start(const std::string& command, const int (&ends)[3]) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (int i = 0; i < 3; ++i) posix_spawn_file_actions_adddup2(&actions, ends[i], i);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF);
  posix_spawnattr_setpgroup(&attributes, 0);
  sigset_t ours;  // what we ignore or heed is not theirs
  sigfillset(&ours);
  posix_spawnattr_setsigdefault(&attributes, &ours);
  const char* const arguments[] = {"sh", "-c", command.c_str(), nullptr};
  std::vector<char*> settings = environment_with(mark_);
  const int error = ::posix_spawn(&pid_, "/bin/sh", &actions, &attributes,
                                  const_cast<char* const*>(arguments), settings.data());
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) {
    pid_ = -1;
    throw no_more_processes(error);
  }
  if (warden_ != nullptr) warden_->begin(pid_);
  process_.emplace(static_cast<int>(::syscall(SYS_pidfd_open, pid_, 0)));
  if (process_->is_open()) return;
  const int refused = errno;
  kill_all();
  throw no_more_processes(refused);
}

Waited ChildProcess::run(ChildTask task, std::string& output) {
  using Clock = std::chrono::steady_clock;
  const auto end_of_patience = Clock::now() + task.timeout;
  for (;;) {
    if (task.close && task.input.empty()) in_.reset();
    const bool ended = serve(task, output);
    if (output.size() > task.most_output) return Waited::too_much;
    if (task.is_complete && task.is_complete(output)) return Waited::done;
    if (ended) return Waited::ended;
    if (task.stop != nullptr && *task.stop) return Waited::stopped;
    if (Clock::now() > end_of_patience) return Waited::timeout;
  }
}

/// Waits a little, and does what there is to do; true once the process has ended and all that it
/// printed was read. What it started itself may go on; nobody waits for that.
bool ChildProcess::serve(ChildTask& task, std::string& output) {
  std::array<pollfd, 4> waits{wait_for(process_, POLLIN), wait_for(out_, POLLIN),
                              wait_for(err_, POLLIN),
                              task.input.empty() ? pollfd{-1, 0, 0} : wait_for(in_, POLLOUT)};
  if (::poll(waits.data(), waits.size(), pause_ms) <= 0) return false;
  if (waits[3].revents != 0) write_some(task.input);
  if (waits[2].revents != 0) read_words();
  if (waits[1].revents != 0 && !read_some(out_->get(), output, task.most_output)) out_.reset();
  if (waits[0].revents == 0) return false;
  end(task, output);
  return true;
}

void ChildProcess::write_some(std::string_view& input) {
  const ssize_t n = ::write(in_->get(), input.data(), input.size());
  if (n >= 0) input.remove_prefix(static_cast<std::size_t>(n));
  if (n >= 0 || errno == EAGAIN || errno == EINTR) return;
  in_.reset();  // it does not want more
  input = {};
}

void ChildProcess::read_words() {
  if (!read_some(err_->get(), words_, most_words)) err_.reset();
  if (words_.size() > most_words) words_.erase(0, words_.size() - most_words);
}

void ChildProcess::end(const ChildTask& task, std::string& output) {
  if (out_) read_some(out_->get(), output, task.most_output);
  if (err_) read_words();
  kill_all();
}

}  // namespace sim
