#pragma once
// The built program, run from outside in a folder of its own: what users and their scripts see.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

using Words = std::vector<std::string>;

constexpr int bad_input = 2, environment = 3;  // exit codes

struct Outcome {
  int code = 0;  // of the exit; minus the signal's number if one killed it
  std::string out, err;
  long peak_kb = 0;  // of its memory
};

inline std::string content(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream all;
  all << in.rdbuf();
  return all.str();
}

/// A program under way, whose stdout is read as it comes.
class Running {
 public:
  Running(pid_t pid, int out, std::filesystem::path err)
      : pid_(pid), out_(out), err_(std::move(err)) {}
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;
  ~Running() {
    if (pid_ > 0) finish(SIGKILL);
  }

  /// The next line with its end; empty at the end of all.
  std::string line() {
    std::string text;
    for (char c = 0; c != '\n' && ::read(out_, &c, 1) == 1;) text += c;
    read_ += text;
    return text;
  }

  /// Returns once the program is ready to be sent this signal, however slowly it starts.
  void await_handler(int signal) const {
    for (int tries = 0; tries < 6000; ++tries) {
      if ((caught() >> (signal - 1) & 1) != 0) return;
      ::usleep(10'000);
    }
    ADD_FAILURE() << "no handler of signal " << signal;
  }

  Outcome finish(int signal = 0) {
    if (signal != 0) ::kill(pid_, signal);
    while (!line().empty()) continue;
    int status = 0;
    rusage used{};
    ::wait4(pid_, &status, 0, &used);
    ::close(out_);
    pid_ = -1;
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    return {code, read_, content(err_), used.ru_maxrss};
  }

 private:
  /// A bit for each signal that has a handler, as the kernel tells.
  unsigned long long caught() const {
    const std::string key = "\nSigCgt:";
    const std::string status = content("/proc/" + std::to_string(pid_) + "/status");
    const std::size_t at = status.find(key);
    return at == std::string::npos ? 0 : std::stoull(status.substr(at + key.size()), nullptr, 16);
  }

  pid_t pid_;
  int out_;
  std::filesystem::path err_;
  std::string read_;
};

/// The digest that a run prints.
inline std::string digest_of(const std::string& text) {
  const std::size_t at = text.find("digest ");
  return at == std::string::npos ? "none in " + text : text.substr(at + 7, 32);
}

class CommandLine : public testing::Test {
 protected:
  CommandLine() {
    std::string name = (std::filesystem::temp_directory_path() / "cosys_cli.XXXXXX").string();
    base_ = ::mkdtemp(name.data());
    std::filesystem::create_directory(folder());
  }
  ~CommandLine() override { std::filesystem::remove_all(base_); }

  /// Where the program runs.
  std::filesystem::path folder() const { return base_ / "here"; }
  std::filesystem::path path(const std::string& name) const { return folder() / name; }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path(name)) << text;
  }

  /// A sweep of few samples: one message a trial, sampled as slowly as the carrier allows.
  void write_scenario(const std::string& name, const std::string& sweep) const {
    write(name,
          "[simulation]\nwarmup_messages = 0\nsample_rate_hz = 250000\n"
          "[stop]\nmax_frames = 16\nmax_frame_errors = 0\n[sweep]\n" +
              sweep + "\n");
  }

  std::set<std::string> files() const {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder()))
      names.insert(entry.path().lexically_relative(folder()).string());
    return names;
  }

  /// `out`: a file for stdout instead of what Outcome has.
  Outcome program(const Words& arguments, const char* out = nullptr) const {
    return start(COSYS_PROGRAM, arguments, out).finish();
  }
  Running start_program(const Words& arguments) const {
    return start(COSYS_PROGRAM, arguments, nullptr);
  }

  Running start_tool(const std::string& name, const Words& arguments) const {
    return start(name, arguments, nullptr);
  }

  /// What another program prints; fails the test if it fails.
  std::string tool(const std::string& name, const Words& arguments) const {
    const Outcome o = start_tool(name, arguments).finish();
    EXPECT_EQ(o.code, 0) << name << ": " << o.err;
    return o.out;
  }

  /// Refused in one line that says so, with nothing on stdout and no file left.
  void expect_refused(const Words& arguments, int code, const std::string& message,
                      const char* out = nullptr) const {
    const std::set<std::string> before = files();
    const Outcome o = program(arguments, out);
    EXPECT_EQ(o.code, code);
    EXPECT_EQ(o.out, "");
    EXPECT_EQ(o.err, "cosys-sim: " + message + "\n");
    EXPECT_EQ(files(), before);
  }

  /// The values of a variable of a result file, as ncdump prints them: "16, 16".
  std::string values(const std::string& file, const std::string& variable) const {
    const std::string dump = tool("ncdump", {"-v", variable, file});
    const std::string key = "\n " + variable + " = ";
    const std::size_t at = dump.rfind(key);
    if (at == std::string::npos) return "no " + variable + " in " + dump;
    return dump.substr(at + key.size(), dump.find(" ;", at) - at - key.size());
  }

 private:
  Running start(const std::string& name, const Words& arguments, const char* out) const {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
    const pid_t pid = ::fork();
    if (pid == 0) become(name, arguments, out, ends[1]);
    ::close(ends[1]);
    return {pid, ends[0], base_ / "stderr"};
  }

  [[noreturn]] void become(const std::string& name, const Words& arguments, const char* out,
                           int pipe) const {
    const int err = ::open((base_ / "stderr").c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0666);
    ::dup2(out != nullptr ? ::open(out, O_WRONLY) : pipe, STDOUT_FILENO);
    ::dup2(err, STDERR_FILENO);
    std::vector<char*> argv = {const_cast<char*>(name.c_str())};
    for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
    argv.push_back(nullptr);
    if (::chdir(folder().c_str()) == 0) ::execvp(argv[0], argv.data());
    ::_exit(127);
  }

  std::filesystem::path base_;
};
