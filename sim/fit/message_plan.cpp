#include "sim/fit/message_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <map>
#include <span>
#include <vector>

#include "dsp/logic_trace.hpp"
#include "protocol/cosys.hpp"
#include "protocol/uart.hpp"
#include "sim/failure.hpp"
#include "sim/fit/drive_plan.hpp"

namespace sim {
namespace {

constexpr double blurred_bits = 0.5;  // by which a pulse may be off, and still be of its bits

/// A message that the recording has whole.
struct WholeMessage {
  std::string text;
  double bit_s = 0;  // by its first and last character
};

dsp::LogicTrace wire_of(const PinRecording& recording) {
  dsp::LogicTrace wire(true, dsp::Seconds(recording.end_s));
  for (const PinPulse& pulse : recording.pulses) {
    wire.add_edge(dsp::Seconds(pulse.start_s));
    wire.add_edge(dsp::Seconds(pulse.end_s));
  }
  return wire;
}

/// One that ends without its newline ends with the pause behind it.
std::vector<WholeMessage> whole_messages(const PinRecording& recording, double baud) {
  const double pause_s = 3 * protocol::bits_per_byte / baud;
  std::vector<WholeMessage> messages;
  protocol::CosysDecoder decoder;
  std::vector<double> starts_s;  // of the line's characters
  for (const protocol::UartByte& byte :
       protocol::receive_mid_bit(wire_of(recording), dsp::Hertz(baud))) {
    if (!starts_s.empty() && byte.start.value > starts_s.back() + pause_s) {
      decoder = protocol::CosysDecoder();
      starts_s.clear();
    }
    starts_s.push_back(byte.start.value);
    const auto frame = decoder.push(byte);
    if (!frame) continue;
    if (frame->outcome == protocol::CosysOutcome::ok)
      messages.push_back({frame->message, (starts_s.back() - starts_s.front()) /
                                              (protocol::bits_per_byte *
                                               static_cast<double>(starts_s.size() - 1))});
    starts_s.clear();
  }
  return messages;
}

std::string most_frequent(const std::vector<WholeMessage>& messages) {
  std::map<std::string, int> times;
  for (const WholeMessage& message : messages) ++times[message.text];
  return std::ranges::max_element(times, {}, [](const auto& one) { return one.second; })->first;
}

/// The light of one message, from its first start bit on.
class LightOfMessage {
 public:
  struct Spell {
    double from_s, to_s;
  };

  LightOfMessage(const std::string& message, double bit_s) : bit_s_(bit_s) {
    const protocol::Bytes bytes = protocol::cosys_encode(message);
    const std::vector<bool> bits = protocol::line_bits(bytes);
    end_s_ = bit_s * static_cast<double>(bits.size());
    for (std::size_t i = 0; i < bits.size(); ++i) {
      if (bits[i]) continue;
      const double at_s = bit_s * static_cast<double>(i);
      if (i == 0 || bits[i - 1]) spells_.push_back({at_s, at_s});
      spells_.back().to_s = at_s + bit_s;
      if (i < protocol::bits_per_byte) first_spells_ = std::ssize(spells_);
    }
  }

  double end_s() const { return end_s_; }
  std::span<const Spell> spells() const { return spells_; }

  /// Whether it may begin with the first of these pulses: they all are of it as long as it lasts,
  /// and none of its first character is missing.
  bool may_begin(std::span<const PinPulse> pulses) const {
    std::vector<bool> is_reported(spells_.size(), false);
    for (const PinPulse& pulse : pulses) {
      const double from_s = pulse.start_s - pulses.front().start_s;
      if (from_s >= end_s_) break;
      const std::size_t spell = spell_of(from_s, pulse.end_s - pulses.front().start_s);
      if (spell == spells_.size()) return false;
      is_reported[spell] = true;
    }
    return std::all_of(is_reported.begin(), is_reported.begin() + first_spells_, std::identity());
  }

 private:
  std::size_t spell_of(double from_s, double to_s) const {
    const double blurred_s = blurred_bits * bit_s_;
    const auto spell = std::ranges::find_if(spells_, [&](const Spell& one) {
      return from_s > one.from_s - blurred_s && to_s < one.to_s + blurred_s;
    });
    return static_cast<std::size_t>(spell - spells_.begin());
  }

  double bit_s_, end_s_ = 0;
  std::vector<Spell> spells_;
  std::ptrdiff_t first_spells_ = 0;  // of the first character
};

void refuse_no_message(bool is_missing, const std::string& file, const std::string& what) {
  if (is_missing)
    throw bad_input("no plan of " + file,
                    "no plan.txt is beside it, no wire in it drives the LED, and " + what,
                    "say --plan PLAN; of messages --message and --baud");
}

}  // namespace

MessagePlan plan_of_messages(const PinRecording& recording, const MessageLight& light,
                             const std::string& file) {
  const std::vector<WholeMessage> whole = whole_messages(recording, light.baud);
  refuse_no_message(whole.empty() && light.message.empty(), file,
                    fmt::format("no message of {:g} Bd is whole in it", light.baud));
  MessagePlan found;
  found.message = light.message.empty() ? most_frequent(whole) : light.message;
  found.whole = std::ranges::count(whole, found.message, &WholeMessage::text);
  const LightOfMessage sent(found.message, whole.empty() ? 1 / light.baud : whole.front().bit_s);
  std::vector<DriveBurst> bursts;
  double end_s = -HUGE_VAL;  // of the last message
  for (std::size_t i = 0; i < recording.pulses.size(); ++i) {
    const double start_s = recording.pulses[i].start_s;
    if (start_s < end_s) continue;
    if (!sent.may_begin(std::span(recording.pulses).subspan(i))) continue;
    ++found.messages;
    for (const auto& spell : sent.spells())
      bursts.push_back({start_s + spell.from_s, light.carrier_hz,
                        static_cast<std::uint64_t>(
                            std::llround((spell.to_s - spell.from_s) * light.carrier_hz))});
    end_s = start_s + sent.end_s();
  }
  refuse_no_message(bursts.empty(), file, "nothing in it begins as that message does");
  found.plan = plan_of_bursts(bursts);
  return found;
}

}  // namespace sim
