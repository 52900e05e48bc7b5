#include "sim/arena/message_queue.hpp"

#include <fmt/format.h>

namespace sim {
namespace {

constexpr std::uint64_t numbers_in_all = 1'000'000;  // six digits

}  // namespace

MessageQueue::MessageQueue(MessageSource source, std::span<const std::string> messages,
                           dsp::Seconds hold, const dsp::RandomAddress& draws)
    : source_(source), messages_(messages), hold_(hold), draws_(draws) {}

/// Holds of a status have no memory, so the first may begin when it is first asked for.
void MessageQueue::change_until(dsp::Seconds now) {
  const auto n = messages_.size();
  if (!status_until_) {
    status_ = draws_.index(n);
    status_until_ = now + draws_.exponential(hold_);
  }
  for (; n > 1 && *status_until_ <= now; *status_until_ += draws_.exponential(hold_))
    status_ = (status_ + 1 + draws_.index(n - 1)) % n;
}

std::string MessageQueue::next(dsp::Seconds now) {
  const std::uint64_t count = sent_++;
  switch (source_) {
    case MessageSource::fixed:
      return messages_.front();
    case MessageSource::list:
      return messages_[count % messages_.size()];
    case MessageSource::counter:
      return fmt::format("{} {:06}", messages_.front(), count % numbers_in_all);
    case MessageSource::status:
      change_until(now);
      return messages_[status_];
  }
  return messages_.front();
}

}  // namespace sim
