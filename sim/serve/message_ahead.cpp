#include "sim/serve/message_ahead.hpp"

#include <utility>

namespace sim {

void MessageAhead::begin(std::shared_ptr<const Link> link, std::uint32_t number) {
  give_up();
  message_ = std::async(std::launch::async, [this, link = std::move(link), number] {
    return make_line_message(*link, number, stop_);
  });
}

bool MessageAhead::is_ready(std::chrono::milliseconds patience) const {
  return message_.wait_for(patience) == std::future_status::ready;
}

void MessageAhead::give_up() {
  stop_ = true;
  if (message_.valid()) message_.wait();
  stop_ = false;
}

}  // namespace sim
