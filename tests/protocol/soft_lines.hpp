#pragma once
// Damaged lines for the tests of the soft decoder. Everything is a function of its seed.
#include <cmath>
#include <string>
#include <vector>

#include "dsp/logic_trace.hpp"
#include "lines.hpp"
#include "protocol/cosys.hpp"
#include "protocol/soft_decoder.hpp"
#include "protocol/uart_receivers.hpp"

namespace protocol::test {

inline const dsp::Seconds bit_time = dsp::period(baud);

/// One sender's wire.
class Sender {
 public:
  explicit Sender(Random& random) : random_(random) {}

  dsp::Hertz rate = baud;
  dsp::Seconds most_late{0};  // each character

  void idle(double bits) {
    at_ += bits * bit_time;
    line_.observe_until(at_);
  }
  /// Where its first character starts.
  dsp::Seconds send(const Bytes& bytes) {
    const dsp::Seconds start = at_ = at_ + lateness();
    for (std::size_t i = 0; i < bytes.size(); ++i)
      at_ = send_byte(line_, bytes[i], i == 0 ? at_ : at_ + lateness(), rate);
    return start;
  }
  dsp::Seconds send(const std::string& message) { return send(cosys_encode(message)); }
  const dsp::LogicTrace& line() const { return line_; }

 private:
  dsp::Seconds lateness() { return uniform(random_, 0, 1) * most_late; }

  Random& random_;
  dsp::Seconds at_{0};
  dsp::LogicTrace line_;
};

struct Damage {
  double holes, flashes;  // per bit of light, of dark
  double length;          // bits, mean
};

/// With holes in its light and flashes in its dark from `from` on.
inline dsp::LogicTrace damaged(const dsp::LogicTrace& line, const Damage& damage, Random& random,
                               dsp::Seconds from = dsp::Seconds(0)) {
  constexpr double step = 1.0 / 32;  // bits
  dsp::LogicTrace bent(line.initial());
  dsp::TraceReader reader(line);
  double broken = 0;  // bits to go
  for (dsp::Seconds t(0); t < line.end(); t += step * bit_time) {
    const bool dark = reader.level_at(t);
    broken -= step;
    const double rate = t < from ? 0 : dark ? damage.flashes : damage.holes;
    if (broken <= 0 && uniform(random, 0, 1) < rate * step)
      broken = -damage.length * std::log1p(-uniform(random, 0, 1));
    bent.set_at(t, dark != (broken > 0));
  }
  bent.set_at(line.end(), true);
  return bent;
}

inline std::string random_message(Random& random, std::size_t most) {
  std::string message(random() % (most + 1), ' ');
  for (char& c : message) c = static_cast<char>(' ' + random() % ('~' - ' ' + 1));
  return message;
}

inline std::vector<std::string> heard_by_soft(const dsp::LogicTrace& line,
                                              SoftMemory memory = SoftMemory::of_messages) {
  std::vector<std::string> messages;
  for (const SoftMessage& message : decode_soft(line, baud, memory))
    messages.push_back(message.message);
  return messages;
}

inline std::vector<std::string> heard_by(const char* receiver, const dsp::LogicTrace& line) {
  std::vector<std::string> messages;
  CosysDecoder decoder;
  for (const UartByte& byte : find_uart_receiver(receiver)->receive(line, baud, 0)) {
    const auto frame = decoder.push(byte);
    if (frame && frame->outcome == CosysOutcome::ok) messages.push_back(frame->message);
  }
  return messages;
}

}  // namespace protocol::test
