#include "sim/serve/line_message.hpp"

#include <cassert>
#include <utility>

#include "sim/trial/decision_trial.hpp"
#include "sim/trial/drawn_trials.hpp"
#include "sim/trial/envelope_trial.hpp"
#include "sim/trial/trial.hpp"

namespace sim {
namespace {

/// Steps 3-7 of a trial.
dsp::LogicTrace pin_of(const Link& link, std::uint32_t trial, const Transmission& sent,
                       const std::atomic<bool>& stop) {
  if (link.decisions) return decided_pin(link, trial, sent);
  if (link.envelope) return envelope_pins(link, trial, {&sent, 1}, &stop).front();
  const auto unit = draw_unit(link, trial);
  return pins_of(link, {&sent}, {chain_input(link, trial, sent, unit)}, &stop, nullptr).front();
}

/// The stop bit's middle, by the receiver's clock.
dsp::Seconds until_read(const Link& link) {
  return dsp::period(link.receiver_baud) * (protocol::bits_per_byte - 0.5);
}

}  // namespace

LineMessage make_line_message(const Link& link, std::uint32_t number,
                              const std::atomic<bool>& stop) {
  assert(link.warmup_messages > 0);
  const Transmission sent = transmit(link, number);
  const SentMessage& counted = sent.messages.back();
  const dsp::Seconds from = sent.messages[sent.messages.size() - 2].end;
  LineMessage message{.number = number,
                      .sent = link.message,
                      .start = counted.byte_start.front() - from,
                      .end = counted.end - from,
                      .bytes = {}};
  for (const auto& byte : receive(link, number, pin_of(link, number, sent, stop)).bytes)
    if (byte.start >= from && byte.start < counted.end)
      message.bytes.push_back(
          {byte.start - from + until_read(link), byte.value, byte.framing_error});
  return message;
}

}  // namespace sim
