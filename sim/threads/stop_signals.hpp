#pragma once
// Signals that end the program, in one place for all commands: at once, or in order where what was
// counted is to be kept. Nothing half written is left behind.
#include <atomic>

namespace sim {

/// For the whole program, before anything else. From now on SIGINT, SIGTERM and SIGHUP (unless
/// nohup has it ignored) say one line on stderr and end the process, code 130. Pipes without a
/// reader and files at their limit become errors of writing, not signals.
void heed_signals();

/// From now on the first of these signals sets the flag returned, so that the command ends in
/// order. One that comes more than a fifth of a second later ends the process at once; one within
/// that time is the same wish, said twice by a terminal and a watchdog.
const std::atomic<bool>& heed_stop_signals();

/// From now on these signals end the process without a word, as in any program: it has nothing more
/// to do, and another one speaks for it.
void leave_stop_signals();

/// As long as one lives a signal that would end the process at once waits: a file that is being
/// written takes its place, or goes away, before. The second signal does not wait.
class EndPutOff {
 public:
  EndPutOff();
  EndPutOff(const EndPutOff&) = delete;
  EndPutOff& operator=(const EndPutOff&) = delete;
  ~EndPutOff();
};

}  // namespace sim
