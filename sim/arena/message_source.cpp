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

/// Holds of a status have no memory, so the first may begin when it is first asked for.
void MessageQueue::change_until(dsp::Seconds now) {
  if (status_until_.value < -1e8) status_until_ = now;
  while (status_until_ <= now) {
    const auto others = static_cast<double>(std::max<std::size_t>(messages_.size() - 1, 1));
    const auto step = 1 + static_cast<std::size_t>(draws_.uniform(next_draw_++) * others);
    status_ = (status_ + step) % messages_.size();
    status_until_ += -std::log1p(-draws_.uniform(next_draw_++)) * hold_;
  }
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
