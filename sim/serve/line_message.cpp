#include "sim/serve/line_message.hpp"

#include <cassert>
#include <utility>

#include "sim/trial/heard_trials.hpp"

namespace sim {
namespace {

/// The stop bit's middle, by the receiver's clock.
dsp::Seconds until_read(const Link& link) {
  return dsp::period(link.receiver_baud) * (protocol::bits_per_byte - 0.5);
}

}  // namespace

LineMessage make_line_message(const Link& link, std::uint32_t number,
                              const std::atomic<bool>& stop) {
  assert(link.warmup_messages > 0);
  HeardTrials heard = hear_trials(link, number, 1, &stop);
  const Transmission& sent = heard.sent.front();
  const SentMessage& counted = sent.messages.back();
  const dsp::Seconds from = sent.messages[sent.messages.size() - 2].end;
  LineMessage message{.number = number,
                      .sent = link.message,
                      .start = counted.byte_start.front() - from,
                      .end = counted.end - from,
                      .bytes = {}};
  for (const auto& byte : receive(link, number, std::move(heard.pins.front())).bytes)
    if (byte.start >= from && byte.start < counted.end)
      message.bytes.push_back(
          {byte.start - from + until_read(link), byte.value, byte.framing_error});
  return message;
}

}  // namespace sim
