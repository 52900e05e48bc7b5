#pragma once
// MessageAhead: the next message of a line, worked out by a thread of its own while the one before
// it is played, so that the player never computes.
#include <atomic>
#include <chrono>
#include <cstdint>
#include <future>
#include <memory>

#include "sim/serve/line_message.hpp"

namespace sim {

class MessageAhead {
 public:
  MessageAhead() = default;
  MessageAhead(const MessageAhead&) = delete;
  MessageAhead& operator=(const MessageAhead&) = delete;
  ~MessageAhead() { give_up(); }

  /// Begins with a message; one that is under way is given up.
  void begin(std::shared_ptr<const Link> link, std::uint32_t number);
  /// Whether it is there, waiting for it so long.
  bool is_ready(std::chrono::milliseconds patience) const;
  /// What was begun, once. Waits for it, and throws what went wrong with it.
  LineMessage take() { return message_.get(); }

 private:
  void give_up();

  std::atomic<bool> stop_ = false;
  std::future<LineMessage> message_;
};

}  // namespace sim
