#include "sim/check/warden.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/syscall.h>
#include <sys/wait.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <random>
#include <set>
#include <string_view>

#include "sim/text/list_text.hpp"

namespace sim {
namespace {

namespace fs = std::filesystem;

constexpr pid_t all_in_order = 0;

/// Of a process of this user; empty for others', and where it cannot be read.
std::string environment_of(const fs::path& process) {
  const Descriptor file(::open((process / "environ").c_str(), O_RDONLY | O_CLOEXEC));
  std::string all;
  std::array<char, 4096> chunk;
  for (;;) {
    const ssize_t n = file.is_open() ? ::read(file.get(), chunk.data(), chunk.size()) : 0;
    if (n <= 0) return all;
    all.append(chunk.data(), static_cast<std::size_t>(n));
  }
}

/// The mark, or one that goes on behind a point.
bool has_mark(std::string_view environment, const std::string& mark) {
  for (const std::string_view setting : split(environment, '\0'))
    if (setting == mark || setting.starts_with(mark + ".")) return true;
  return false;
}

/// 0 for what is no process.
pid_t process_of(std::string_view name) {
  pid_t number = 0;
  const auto [rest, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  return error == std::errc() && rest == name.data() + name.size() ? number : 0;
}

/// Whether it was one that has the mark. By its descriptor, as its number may soon be another's.
bool kill_if_marked(pid_t number, const fs::path& entry, const std::string& mark) {
  const Descriptor process(static_cast<int>(::syscall(SYS_pidfd_open, number, 0)));
  return process.is_open() && has_mark(environment_of(entry), mark) &&
         ::syscall(SYS_pidfd_send_signal, process.get(), SIGKILL, nullptr, 0) == 0;
}

/// How many had it.
int kill_marked(const std::string& mark) {
  int found = 0;
  std::error_code error;
  fs::directory_iterator entry("/proc", error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    const pid_t process = process_of(entry->path().filename().string());
    if (process == 0 || process == ::getpid()) continue;
    found += kill_if_marked(process, entry->path(), mark);
  }
  return found;
}

/// Some may start others while they are looked for.
void kill_all_marked(const std::string& mark) {
  constexpr int most_rounds = 100;
  for (int round = 0; round < most_rounds && kill_marked(mark) > 0; ++round) ::usleep(1000);
}

/// Nothing that is open here stays open because of it, and no signal to its makers' group ends it.
void keep_apart(int from) {
  ::setsid();
  const int nowhere = ::open("/dev/null", O_RDWR);
  for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream) ::dup2(nowhere, stream);
  ::dup2(from, STDIN_FILENO);
  ::close_range(STDERR_FILENO + 1, ~0U, 0);
  for (const int wish : {SIGINT, SIGTERM, SIGHUP}) std::signal(wish, SIG_IGN);
}

[[noreturn]] void watch(int from, const std::string& mark, const fs::path& folder) noexcept {
  keep_apart(from);
  std::set<pid_t> groups;
  for (pid_t told = 0; ::read(STDIN_FILENO, &told, sizeof told) == sizeof told;) {
    if (told == all_in_order) ::_exit(0);
    if (told > 0) groups.insert(told);
    if (told < 0) groups.erase(-told);
  }
  for (const pid_t group : groups) ::kill(-group, SIGKILL);
  kill_all_marked(mark);
  std::error_code error;
  if (!folder.empty()) fs::remove_all(folder, error);
  ::_exit(0);
}

/// Nobody else's, in whatever container.
std::string new_mark() {
  std::random_device random;
  return fmt::format("{}{:08x}{:08x}", Warden::mark_name, random(), random());
}

}  // namespace

Failure no_more_processes(int error) {
  return {ExitCode::environment,
          fmt::format("cannot start another program ({}) use fewer threads, or end other programs",
                      std::strerror(error))};
}

Warden::Warden(const fs::path& folder) : mark_(new_mark()), to_(-1) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) throw no_more_processes(errno);
  const Descriptor from(ends[0]);
  to_ = Descriptor(ends[1]);
  process_ = ::fork();
  if (process_ < 0) throw no_more_processes(errno);
  if (process_ == 0) watch(ends[0], mark_, folder);
}

Warden::~Warden() {
  end_marked(mark_);
  tell(all_in_order);
  ::waitpid(process_, nullptr, 0);
}

std::string Warden::next_mark() const { return mark_ + "." + std::to_string(++programs_); }

void Warden::end_marked(const std::string& mark) const { kill_all_marked(mark); }

/// Where it was killed itself, nobody listens, and all goes on.
void Warden::tell(pid_t group) const {
  [[maybe_unused]] const ssize_t told = ::write(to_.get(), &group, sizeof group);
}

}  // namespace sim
