#include "sim/arena/message_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace sim {
namespace {

constexpr std::array table{MessageSourceName{"fixed", MessageSource::fixed},
                           MessageSourceName{"list", MessageSource::list},
                           MessageSourceName{"counter", MessageSource::counter},
                           MessageSourceName{"status", MessageSource::status}};

constexpr std::uint64_t counts = 1'000'000;  // six digits

}  // namespace

std::span<const MessageSourceName> message_sources() { return table; }

MessageSource find_message_source(std::string_view name) {
  return std::ranges::find(table, name, &MessageSourceName::name)->source;
}

MessageQueue::MessageQueue(MessageSource source, std::span<const std::string> messages,
                           dsp::Seconds hold, const dsp::RandomAddress& draws)
    : source_(source), messages_(messages), hold_(hold), draws_(draws) {}

dsp::Seconds MessageQueue::draw_hold() { return -std::log1p(-uniform()) * hold_; }

/// Holds of a status have no memory, so the first may begin when it is first asked for.
void MessageQueue::change_until(dsp::Seconds now) {
  const auto n = messages_.size();
  if (!status_until_) {
    status_ = static_cast<std::size_t>(uniform() * static_cast<double>(n));
    status_until_ = now + draw_hold();
  }
  for (; n > 1 && *status_until_ <= now; *status_until_ += draw_hold())
    status_ = (status_ + 1 + static_cast<std::size_t>(uniform() * static_cast<double>(n - 1))) % n;
}

std::string MessageQueue::next(dsp::Seconds now) {
  const std::uint64_t count = sent_++;
  switch (source_) {
    case MessageSource::fixed:
      return messages_.front();
    case MessageSource::list:
      return messages_[count % messages_.size()];
    case MessageSource::counter:
      return fmt::format("{} {:06}", messages_.front(), count % counts);
    case MessageSource::status:
      change_until(now);
      return messages_[status_];
  }
  return messages_.front();
}

}  // namespace sim
