#include "sim/threads/stop_signals.hpp"

#include <unistd.h>

#include <chrono>
#include <csignal>
#include <string_view>

#include "sim/failure.hpp"

namespace sim {
namespace {

// What a handler may touch: lock-free atomics, the steady clock, write and _exit.
using Clock = std::chrono::steady_clock;
static_assert(std::atomic<Clock::rep>::is_always_lock_free);

std::atomic<bool> stopping = false;
std::atomic<Clock::rep> first_at = 0;

void say_stopping() {
  constexpr std::string_view line =
      "cosys-sim: stopping (signal) keeping what was counted; once more to stop at once\n";
  [[maybe_unused]] const ssize_t said = ::write(STDERR_FILENO, line.data(), line.size());
}

void on_signal(int) {
  const Clock::rep now = Clock::now().time_since_epoch().count();
  if (!stopping.exchange(true)) {
    first_at = now;
    return say_stopping();
  }
  if (Clock::duration(now - first_at) > std::chrono::milliseconds(200))
    ::_exit(static_cast<int>(ExitCode::interrupted));
}

void heed(int signal) {
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  for (const int other : {SIGINT, SIGTERM, SIGHUP}) ::sigaddset(&action.sa_mask, other);
  ::sigaction(signal, &action, nullptr);
}

}  // namespace

const std::atomic<bool>& heed_stop_signals() {
  heed(SIGINT);
  heed(SIGTERM);
  if (std::signal(SIGHUP, SIG_IGN) != SIG_IGN) heed(SIGHUP);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  return stopping;
}

}  // namespace sim
