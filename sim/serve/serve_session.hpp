#pragma once
// ServeSession: a line played at a port: its bytes out at their instants, changes of the scenario
// in, until its time is over, "quit" or a signal comes. What is played depends on the scenario, its
// seed and the changes alone; the clock of the machine says only when.
#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>

#include "dsp/units.hpp"
#include "sim/failure.hpp"
#include "sim/serial/line_input.hpp"
#include "sim/serial/line_output.hpp"
#include "sim/serial/port.hpp"
#include "sim/serve/line_decoder.hpp"
#include "sim/serve/line_message.hpp"
#include "sim/serve/line_player.hpp"
#include "sim/serve/live_scenario.hpp"
#include "sim/serve/message_ahead.hpp"
#include "sim/serve/serve_settings.hpp"

namespace sim {

class ServeSession {
 public:
  /// Changes come from stdin, "key=value"; when that ends, the line goes on. `messages` gets a line
  /// for each message that was played; it may be nothing.
  ServeSession(LiveScenario scenario, Port& port, LineOutput* messages,
               const ServeSettings& settings);

  /// Done after its duration or by "quit", interrupted by the flag.
  ExitCode run(const std::atomic<bool>& stopping);

 private:
  using Clock = std::chrono::steady_clock;

  void await_reader();
  void play();
  bool goes_on() const;
  /// The next message takes the place of the one that was played.
  void begin_message();
  void report_message();
  void send(dsp::Seconds now);
  void wait(dsp::Seconds at_most);
  void heed(const std::string& line);
  void change(const std::string& key_and_value);
  void report_lag();
  void report_end() const;

  /// On the wall.
  dsp::Seconds since_start() const;
  /// On the line's clock, which ends with the duration.
  dsp::Seconds now() const;
  dsp::Seconds on_the_wall(dsp::Seconds time) const { return time / settings_.speed; }
  /// Of the message, on the line's clock: then the next one takes its place.
  dsp::Seconds played_end() const;

  LiveScenario scenario_;
  Port& port_;
  LineOutput* messages_;
  ServeSettings settings_;
  LineInput input_;
  const std::atomic<bool>* stopping_ = nullptr;
  bool quit_ = false, has_lagged_ = false;

  MessageAhead ahead_;
  std::uint32_t next_ = 0;  // message, which is being made
  LineMessage message_;     // is played from `origin_` on
  dsp::Seconds origin_{};
  LinePlayer player_;
  LineDecoder decoder_;
  Clock::time_point start_;

  std::uint64_t n_messages_ = 0, n_ok_ = 0, n_bytes_ = 0, n_lost_ = 0;
  std::uint64_t n_lost_of_message_ = 0, n_lines_lost_ = 0;
};

}  // namespace sim
