#include "sim/threads/stop_signals.hpp"

#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <string_view>

#include "sim/failure.hpp"

namespace sim {
namespace {

// What a handler may touch: lock-free atomics, the steady clock, write and _exit.
using Clock = std::chrono::steady_clock;
static_assert(std::atomic<Clock::rep>::is_always_lock_free);

std::atomic<bool> in_order = false;  // whether somebody looks at `stopping`
std::atomic<bool> stopping = false;
std::atomic<int> put_off = 0;
std::atomic<Clock::rep> first_at = 0;  // 0: no signal yet

void tell(std::string_view line) {
  [[maybe_unused]] const ssize_t said = ::write(STDERR_FILENO, line.data(), line.size());
}

[[noreturn]] void end_now() { ::_exit(static_cast<int>(ExitCode::interrupted)); }

void begin_to_stop() {
  if (in_order) return tell("cosys-sim: stopping (signal) once more to stop at once\n");
  tell("cosys-sim: interrupted (by a signal)\n");
  if (put_off == 0) end_now();
}

void heed_wish() {
  const Clock::rep now = Clock::now().time_since_epoch().count();
  Clock::rep first = 0;
  if (first_at.compare_exchange_strong(first, now)) {
    stopping = true;
    return begin_to_stop();
  }
  if (Clock::duration(now - first) > std::chrono::milliseconds(200)) end_now();
}

void on_signal(int) {
  const int interrupted = errno;  // of what goes on behind it
  heed_wish();
  errno = interrupted;
}

void heed(int signal) {
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  for (const int other : {SIGINT, SIGTERM, SIGHUP}) ::sigaddset(&action.sa_mask, other);
  ::sigaction(signal, &action, nullptr);
}

}  // namespace

void heed_signals() {
  heed(SIGINT);
  heed(SIGTERM);
  if (std::signal(SIGHUP, SIG_IGN) != SIG_IGN) heed(SIGHUP);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGCHLD, SIG_DFL);  // ignored, it would hide how decoders end
}

const std::atomic<bool>& heed_stop_signals() {
  in_order = true;
  return stopping;
}

void leave_stop_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    if (std::signal(signal, SIG_DFL) == SIG_IGN) std::signal(signal, SIG_IGN);  // as nohup has it
}

EndPutOff::EndPutOff() { ++put_off; }

EndPutOff::~EndPutOff() {
  if (--put_off == 0 && stopping && !in_order) end_now();
}

}  // namespace sim
