#include "sim/arena/sending.hpp"

#include <algorithm>

#include "dsp/random_stream.hpp"
#include "protocol/cosys.hpp"
#include "protocol/short_pulses.hpp"
#include "protocol/uart.hpp"
#include "sim/threads/random_spells.hpp"

namespace sim {
namespace {

using dsp::Seconds;

/// Purposes of one sender's draws in a run, added to the address that it is given.
constexpr std::uint32_t pauses = 0, contents = 1, spells = 2;

/// Pauses between messages.
class Pauses {
 public:
  Pauses(const Sender& sender, const dsp::RandomAddress& draws) : sender_(sender), draws_(draws) {
    if (!sender.intervals.empty()) at_ = draws_.index(sender.intervals.size());
  }

  double uniform() { return draws_.uniform(); }

  Seconds next() {
    if (!sender_.intervals.empty()) return sender_.intervals[at_++ % sender_.intervals.size()];
    return sender_.interval_min + draws_.uniform() * (sender_.interval_max - sender_.interval_min);
  }

 private:
  const Sender& sender_;
  dsp::RandomStream draws_;
  std::size_t at_ = 0;
};

/// Bytes on the line of each message that it may send.
std::vector<std::size_t> sizes_of(const Sender& sender) {
  const bool counts = sender.source == MessageSource::counter;
  const bool only_first = counts || sender.source == MessageSource::fixed;
  std::vector<std::size_t> sizes;
  for (const std::string& message : sender.messages)
    sizes.push_back(message.size() + (counts ? counter_size : 0) + protocol::tail_size);
  if (only_first) sizes.resize(1);
  return sizes;
}

Seconds mean_frame(const Sender& sender) {
  Seconds sum;
  const auto sizes = sizes_of(sender);
  for (const std::size_t size : sizes) sum += frame_time(sender, size);
  return sum / static_cast<double>(sizes.size());
}

Seconds mean_pause(const Sender& sender) {
  if (sender.intervals.empty()) return (sender.interval_min + sender.interval_max) * 0.5;
  Seconds sum;
  for (const Seconds interval : sender.intervals) sum += interval;
  return sum / static_cast<double>(sender.intervals.size());
}

Seconds mean_period(const Sender& sender) { return mean_frame(sender) + mean_pause(sender); }

/// Periods after which messages and pauses repeat themselves, if not too many to be waited for.
double periods_in_turn(const Sender& sender) {
  constexpr double most = 100;
  const auto n = std::max<std::size_t>(sender.intervals.size(), 1);
  const auto m = sender.source == MessageSource::list ? sender.messages.size() : 1;
  return std::min(static_cast<double>(n * m), most);
}

dsp::RandomAddress purpose(dsp::RandomAddress draws, std::uint32_t which) {
  draws.purpose += which << 8U;
  return draws;
}

}  // namespace

Seconds frame_time(const Sender& sender, std::size_t bytes) {
  return static_cast<double>(bytes * protocol::bits_per_byte) * dsp::period(sender.baud);
}

Seconds longest_frame(const Sender& sender) {
  return frame_time(sender, std::ranges::max(sizes_of(sender)));
}

double mean_load(const Sender& sender) {
  return time_between_spells(sender.silence) * (mean_frame(sender) / mean_period(sender));
}

/// Half the data bits of a message are taken as light.
double mean_light(const Sender& sender) {
  constexpr double lit_slots = (1 + protocol::data_bits / 2.0) / protocol::bits_per_byte;
  const double lit =
      sender.pulse > Seconds(0) ? sender.pulse / dsp::period(sender.baud) : 1;  // of a slot
  return sender.duty * lit_slots * lit * mean_load(sender);
}

SentFrames send(const Sender& sender, const dsp::RandomAddress& draws, Seconds end) {
  constexpr double periods_before = 10;
  Pauses pause(sender, purpose(draws, pauses));
  Seconds at = -(periods_before + pause.uniform() * periods_in_turn(sender)) * mean_period(sender);
  MessageQueue queue(sender.source, sender.messages, sender.status_hold, purpose(draws, contents));
  RandomSpells silence(sender.silence, purpose(draws, spells), at);
  SentFrames sent{dsp::LogicTrace(true), {}};
  while (at < end) {
    SentFrame frame{at, at, queue.next(at), silence.has(at)};
    const protocol::Bytes bytes = protocol::cosys_encode(frame.message);
    frame.end = at + frame_time(sender, bytes.size());
    if (frame.end > Seconds(0)) {
      if (!frame.silent)
        for (const std::uint8_t byte : bytes)
          at = protocol::send_byte_in_pulses(sent.drive, byte, at, sender.baud, sender.pulse);
      sent.frames.push_back(frame);
    }
    at = frame.end + pause.next();
  }
  return sent;
}

}  // namespace sim
