#pragma once
// Signals that end a run in order: what was counted is kept.
#include <atomic>

namespace sim {

/// From now on SIGINT, SIGTERM and SIGHUP (unless nohup has it ignored) say one line on stderr and
/// set the flag returned. One that comes more than a fifth of a second later ends the process at
/// once, code 130; one within that time is the same wish, said twice by a terminal and a watchdog.
/// Pipes without a reader and files at their limit become errors of writing, not signals.
const std::atomic<bool>& heed_stop_signals();

}  // namespace sim
