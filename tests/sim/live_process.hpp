#pragma once
// The program as it runs on, from outside: a stdin to write to, lines of stdout to wait for, and
// descriptors of ports.
#include <fcntl.h>
#include <poll.h>
#include <sys/syscall.h>

#include <chrono>
#include <csignal>
#include <functional>
#include <nlohmann/json.hpp>
#include <string_view>
#include <thread>

#include "program.hpp"

/// How long a test waits for one thing, which takes no second on a machine that has time for it.
class Patience {
 public:
  /// Waits until there is something to read; throws if there is nothing, or the time is over.
  void await_input(int descriptor, const std::string& what) const {
    await(POLLIN, descriptor, what);
  }
  /// ... until something can be written.
  void await_room(int descriptor, const std::string& what) const {
    await(POLLOUT, descriptor, what);
  }

 private:
  using Clock = std::chrono::steady_clock;

  void await(short event, int descriptor, const std::string& what) const {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(end_ - Clock::now()).count();
    pollfd one{.fd = descriptor, .events = event, .revents = 0};
    if (left <= 0 || ::poll(&one, 1, static_cast<int>(left)) != 1)
      throw std::runtime_error("waited in vain for " + what);
  }

  Clock::time_point end_ = Clock::now() + std::chrono::seconds(60);
};

/// What comes, up to and with this. What is behind it is left, so bytes are read one by one.
inline std::string read_until(int descriptor, const std::string& end) {
  const Patience patience;
  std::string text;
  for (char c = 0; !text.ends_with(end); text += c) {
    patience.await_input(descriptor, end);
    if (::read(descriptor, &c, 1) != 1) throw std::runtime_error("the end, behind " + text);
  }
  return text;
}

/// To a descriptor that is non-blocking.
inline void write_all(int descriptor, std::string_view text) {
  const Patience patience;
  while (!text.empty()) {
    patience.await_room(descriptor, "being read");
    const ssize_t n = ::write(descriptor, text.data(), text.size());
    if (n > 0) text.remove_prefix(static_cast<std::size_t>(n));
  }
}

class LiveProcess {
 public:
  LiveProcess(const std::filesystem::path& folder, const Words& arguments)
      : err_(folder.parent_path() / ("err" + std::to_string(++n_started))) {
    int in[2], out[2];
    if (::pipe2(in, O_CLOEXEC) != 0 || ::pipe2(out, O_CLOEXEC) != 0)
      throw std::runtime_error("no pipe");
    pid_ = ::fork();
    if (pid_ == 0) become(folder, arguments, in[0], out[1]);
    ::close(in[0]);
    ::close(out[1]);
    in_ = in[1];
    out_ = out[0];
  }
  LiveProcess(const LiveProcess&) = delete;
  LiveProcess& operator=(const LiveProcess&) = delete;
  ~LiveProcess() {
    if (pid_ > 0) finish(SIGKILL);
  }

  void write(const std::string& text) const {
    ASSERT_EQ(::write(in_, text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }
  void close_stdin() { ::close(std::exchange(in_, -1)); }

  using Wanted = std::function<bool(const nlohmann::json&)>;
  /// The next line that is so; those before it are passed over.
  nlohmann::json wait_until(const std::string& what, const Wanted& is_wanted) {
    const Patience patience;
    for (;;) {
      const std::string text = line(patience, what);
      if (text.empty()) throw std::runtime_error("no " + what + " in " + read_ + content(err_));
      const auto json = nlohmann::json::parse(text);
      if (is_wanted(json)) return json;
    }
  }

  /// Until it has said so on stderr.
  void await_words(const std::string& words) const {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (content(err_).find(words) == std::string::npos) {
      if (std::chrono::steady_clock::now() > end)
        throw std::runtime_error("waited in vain for " + words + " in " + content(err_));
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }

  /// Until then nobody reads its stdout.
  void await_exit(int signal = 0) const {
    if (signal != 0) ::kill(pid_, signal);
    const auto process = static_cast<int>(::syscall(SYS_pidfd_open, pid_, 0));
    Patience().await_input(process, "its exit");
    ::close(process);
  }

  /// All lines of its life are in `out`.
  Outcome finish(int signal = 0) {
    if (signal != 0) ::kill(pid_, signal);
    const Patience patience;
    while (!line(patience, "the end").empty()) continue;
    int status = 0;
    ::waitpid(std::exchange(pid_, -1), &status, 0);
    ::close(out_);
    if (in_ >= 0) close_stdin();
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    return {code, read_, content(err_)};
  }

 private:
  std::string line(const Patience& patience, const std::string& what) {
    while (ahead_.find('\n') == std::string::npos) {
      patience.await_input(out_, what);
      char some[4096];
      const ssize_t n = ::read(out_, some, sizeof some);
      if (n <= 0) break;
      ahead_.append(some, static_cast<std::size_t>(n));
    }
    const std::string text = ahead_.substr(0, ahead_.find('\n') + 1);  // all where there is none
    ahead_.erase(0, text.size());
    read_ += text;
    return text;
  }

  [[noreturn]] void become(const std::filesystem::path& folder, const Words& arguments, int in,
                           int out) const {
    ::dup2(in, STDIN_FILENO);
    ::dup2(out, STDOUT_FILENO);
    ::dup2(::open(err_.c_str(), O_CREAT | O_TRUNC | O_WRONLY | O_CLOEXEC, 0666), STDERR_FILENO);
    std::vector<char*> argv = {const_cast<char*>(COSYS_PROGRAM)};
    for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
    argv.push_back(nullptr);
    if (::chdir(folder.c_str()) == 0) ::execv(argv[0], argv.data());
    ::_exit(127);
  }

  static inline int n_started = 0;
  std::filesystem::path err_;
  pid_t pid_ = -1;
  int in_ = -1, out_ = -1;
  std::string read_;
  std::string ahead_;  // of lines that nobody wanted yet
};

inline const std::string stopping = "cosys-sim: stopping (signal) once more to stop at once\n";
