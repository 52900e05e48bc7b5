#pragma once
// `cosys-sim node` from outside: processes with a stdin to write to and events to wait for, and a
// pseudo-terminal whose other end is the test's own.
#include <fcntl.h>
#include <poll.h>
#include <sys/syscall.h>
#include <termios.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string_view>

#include "program.hpp"
#include "protocol/shared_link.hpp"

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

/// What comes, up to and with this.
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

class NodeProcess {
 public:
  NodeProcess(const std::filesystem::path& folder, Words arguments)
      : err_(folder.parent_path() / ("err" + std::to_string(++n_started))) {
    arguments.insert(arguments.begin(), "node");
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
  NodeProcess(const NodeProcess&) = delete;
  NodeProcess& operator=(const NodeProcess&) = delete;
  ~NodeProcess() {
    if (pid_ > 0) finish(SIGKILL);
  }

  void write(const std::string& text) const {
    ASSERT_EQ(::write(in_, text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }
  void close_stdin() { ::close(std::exchange(in_, -1)); }

  /// The next event that is so; those before it are passed over.
  nlohmann::json wait_for(const std::string& event, const nlohmann::json& with = {}) {
    const std::string what = event + " " + with.dump();
    const Patience patience;
    for (;;) {
      const std::string text = line(patience, what);
      if (text.empty()) throw std::runtime_error("no " + what + " in " + read_ + content(err_));
      auto json = nlohmann::json::parse(text);
      auto wanted = json;
      wanted.update(with.is_null() ? nlohmann::json::object() : with);
      if (json.at("event") == event && wanted == json) return json;
    }
  }
  nlohmann::json wait_for_value(const std::string& name, const std::string& value) {
    return wait_for("changed", {{"name", name}, {"value", value}});
  }

  /// Until then nobody reads its events.
  void await_exit(int signal = 0) const {
    if (signal != 0) ::kill(pid_, signal);
    const auto process = static_cast<int>(::syscall(SYS_pidfd_open, pid_, 0));
    Patience().await_input(process, "its exit");
    ::close(process);
  }

  /// All events of its life are in `out`.
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
    std::string text;
    for (char c = 0; c != '\n'; text += c) {
      patience.await_input(out_, what);
      if (::read(out_, &c, 1) != 1) break;
    }
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
};

/// The last event of a node.
inline nlohmann::json end_of(const Outcome& o) {
  const std::size_t last = o.out.rfind('\n', o.out.size() - 2);
  return nlohmann::json::parse(o.out.substr(last == std::string::npos ? 0 : last + 1));
}

/// A pseudo-terminal that stands for a device: the node has its end, the test the other.
class TestDevice {
 public:
  TestDevice() : ours_(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)) {
    if (::grantpt(ours_) != 0 || ::unlockpt(ours_) != 0) throw std::runtime_error("no pty");
    name_ = ::ptsname(ours_);
    kept_ = ::open(name_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
  }
  TestDevice(const TestDevice&) = delete;
  TestDevice& operator=(const TestDevice&) = delete;
  ~TestDevice() {
    vanish();
    ::close(kept_);
  }

  const std::string& name() const { return name_; }
  /// Is pulled out.
  void vanish() {
    if (ours_ >= 0) ::close(std::exchange(ours_, -1));
  }
  /// Takes no bytes from the node, until it does again.
  void stop() const { ::tcflow(kept_, TCOOFF); }
  void resume() const { ::tcflow(kept_, TCOON); }
  termios settings() const {
    termios now{};
    ::tcgetattr(kept_, &now);
    return now;
  }
  void write(const std::string& text) const { write_all(ours_, text); }
  /// What the node sends, up to and with this.
  std::string read_until(const std::string& end) const { return ::read_until(ours_, end); }

 private:
  int ours_, kept_ = -1;  // kept, so that its settings outlive the node
  std::string name_;
};

/// A message from the guard, node B, to the base, node A.
inline std::string from_guard(const std::vector<protocol::SharedLinkField>& fields) {
  const auto bytes = protocol::shared_link_encode({'A', 'B', fields});
  return {bytes.begin(), bytes.end()};
}

/// Two ends of one link, as files in the folder: base.toml has A, guard.toml has B.
class Nodes : public CommandLine {
 protected:
  Nodes() {
    std::signal(SIGPIPE, SIG_IGN);  // a node that has died fails its test alone
    write("base.toml", "address = \"A\"\npeer = \"B\"\n" + common +
                           "outbound = [\"Goal\", \"Speed\"]\ninbound = [\"Lat\", \"Lon\"]\n"
                           "[values]\nGoal = \"gate 3\"\nSpeed = \"1.5\"\n");
    write("guard.toml", "address = \"B\"\npeer = \"A\"\n" + common +
                            "outbound = [\"Lat\", \"Lon\"]\ninbound = [\"Goal\", \"Speed\"]\n"
                            "[values]\nLat = \"40.1\"\nLon = \"-113.1\"\n");
  }

  std::unique_ptr<NodeProcess> start_node(const Words& arguments) const {
    return std::make_unique<NodeProcess>(folder(), arguments);
  }
  /// Has opened its port when this returns.
  std::unique_ptr<NodeProcess> ready_node(const Words& arguments) const {
    auto node = start_node(arguments);
    node->wait_for("ready");
    return node;
  }
  std::unique_ptr<NodeProcess> base_at(const TestDevice& device) const {
    return ready_node({"base.toml", "--device", device.name()});
  }

  /// A file like another, with a line more.
  void write_like(const std::string& old, const std::string& line, const std::string& name) const {
    write(name, line + "\n" + content(path(old)));
  }

  const std::string common = "baud = 115200\nsend_period_s = 0.01\n";
};

inline const std::string stopping =
    "cosys-sim: stopping (signal) keeping what was counted; once more to stop at once\n";
