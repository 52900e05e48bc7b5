#pragma once
// How long things take on the wall's clock.
#include <chrono>

namespace sim {

class Stopwatch {
 public:
  /// Not running it costs nothing and says 0.
  explicit Stopwatch(bool running = true) : running_(running), began_(now()) {}

  /// Seconds since the last lap, or the begin.
  double seconds() const { return std::chrono::duration<double>(now() - began_).count(); }
  /// The same, and begins the next lap.
  double lap() {
    const Clock::time_point then = began_;
    began_ = now();
    return std::chrono::duration<double>(began_ - then).count();
  }

 private:
  using Clock = std::chrono::steady_clock;

  Clock::time_point now() const { return running_ ? Clock::now() : Clock::time_point(); }

  bool running_;
  Clock::time_point began_;
};

}  // namespace sim
