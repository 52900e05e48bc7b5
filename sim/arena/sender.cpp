#include "sim/arena/sender.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <cmath>

#include "protocol/cosys.hpp"
#include "protocol/uart.hpp"
#include "sim/failure.hpp"
#include "sim/link.hpp"
#include "sim/list_text.hpp"
#include "sim/number_text.hpp"

namespace sim {
namespace {

using dsp::Seconds;

/// Purposes of one sender's draws in a run, added to the address that it is given.
constexpr std::uint32_t pauses = 0, contents = 1, spells = 2;

// ---- from the scenario ----

/// "{}" in a message is the number of the device.
std::string numbered(std::string_view message, int number) {
  std::string text(message);
  const std::string digits = std::to_string(number);
  for (std::size_t at = 0; (at = text.find("{}", at)) != std::string::npos; at += digits.size())
    text.replace(at, 2, digits);
  return text;
}

std::vector<std::string> messages_of(const std::string& name, const PlacedDevice& device,
                                     int number) {
  const bool counts = find_message_source(device.source) == MessageSource::counter;
  std::vector<std::string> messages;
  for (const std::string_view message : split(device.messages, '\n')) {
    messages.push_back(numbered(message, number));
    const std::size_t longest = protocol::longest_message - (counts ? counter_size : 0);
    if (messages.back().size() > longest)
      throw bad_input(fmt::format("devices.{}.messages = \"{}...\"", name, message.substr(0, 40)),
                      fmt::format("it becomes {} characters", messages.back().size()),
                      fmt::format("use at most {}", longest));
  }
  return messages;
}

std::vector<Seconds> intervals_of(const PlacedDevice& device) {
  std::vector<Seconds> intervals;
  if (device.intervals_ms.empty()) return intervals;
  for (const double ms : parse_values(device.intervals_ms, "intervals_ms"))
    intervals.emplace_back(ms * 1e-3);
  return intervals;
}

double or_else(double value, double standard) { return std::isnan(value) ? standard : value; }

/// Draws of the devices of a kind, each from -1/2 to 1/2.
class Scatter {
 public:
  Scatter(std::uint64_t seed, const std::string& name) : address_{.seed = seed, .purpose = 0x61} {
    for (const char c : name) address_.point = address_.point * 31 + static_cast<unsigned char>(c);
  }
  double next() { return address_.uniform(at_++) - 0.5; }

 private:
  dsp::RandomAddress address_;
  std::uint32_t at_ = 0;
};

Sender make_sender(const Scenario& s, const std::string& name, const PlacedDevice& d, int number,
                   Scatter& scatter) {
  const auto off_by = [&](double nominal, double ppm, double spread_ppm) {
    return dsp::Hertz(nominal * (1 + (ppm + spread_ppm * scatter.next()) * 1e-6));
  };
  Sender sender;
  sender.kind = name;
  sender.name = d.count > 1 ? fmt::format("{}-{}", name, number) : name;
  sender.number = number;
  sender.x_m = d.x_m + d.spread_x_m * scatter.next();
  sender.y_m = d.y_m + d.spread_y_m * scatter.next();
  sender.height_m = or_else(d.height_mm, s.led.height_mm) * 1e-3;
  sender.yaw = dsp::degrees(d.yaw_deg + d.yaw_spread_deg * scatter.next());
  sender.leds = static_cast<int>(d.leds);
  sender.emitter = d.led.empty() ? s.emitter : d.emitter;
  sender.current = dsp::Amperes(or_else(d.current_ma, s.led.current_ma) * 1e-3);
  sender.carrier = off_by(s.device.carrier_hz, d.carrier_error_ppm, d.carrier_spread_ppm);
  sender.duty = s.device.carrier_duty;
  sender.baud = off_by(s.device.baud, d.clock_error_ppm, d.clock_spread_ppm);
  sender.source = find_message_source(d.source);
  sender.messages = messages_of(name, d, number);
  sender.status_hold = Seconds(d.status_hold_s);
  sender.interval_min = Seconds(d.interval_min_ms * 1e-3);
  sender.interval_max = Seconds(d.interval_max_ms * 1e-3);
  sender.intervals = intervals_of(d);
  sender.silent_every = Seconds(d.silent_every_s);
  sender.silent_for = Seconds(d.silent_for_s);
  return sender;
}

/// By device, and by what is around all of them: one device more leaves the others as they are.
void name_draws(const Scenario& s, std::vector<Sender>& senders) {
  Scenario around = s;
  around.devices.clear();
  const std::uint32_t hash = point_hash(around);
  for (Sender& sender : senders) {
    const std::string device = fmt::format("{}-{}", sender.kind, sender.number);
    sender.point = XXH32(device.data(), device.size(), hash);
  }
}

// ---- in a run ----

/// Pauses between messages.
class Pauses {
 public:
  Pauses(const Sender& sender, const dsp::RandomAddress& draws) : sender_(sender), draws_(draws) {
    if (!sender.intervals.empty())
      at_ = static_cast<std::size_t>(uniform() * static_cast<double>(sender.intervals.size()));
  }

  double uniform() { return draws_.uniform(next_++); }

  Seconds next() {
    if (!sender_.intervals.empty()) return sender_.intervals[at_++ % sender_.intervals.size()];
    return sender_.interval_min + uniform() * (sender_.interval_max - sender_.interval_min);
  }

 private:
  const Sender& sender_;
  dsp::RandomAddress draws_;
  std::uint32_t next_ = 0;
  std::size_t at_ = 0;
};

/// Spells in which a device has other things to do: exponential, so that they have no memory and
/// the first may be looked for at any time.
class SilentSpells {
 public:
  SilentSpells(const Sender& sender, const dsp::RandomAddress& draws, Seconds from)
      : sender_(sender), draws_(draws), until_(from) {
    const Seconds cycle = sender.silent_every + sender.silent_for;
    silent_ = uniform() * cycle.value >= sender.silent_for.value;  // flipped at once
    flip();
  }

  /// Times asked must not decrease.
  bool silent_at(Seconds t) {
    if (sender_.silent_every.value <= 0) return false;
    while (until_ <= t) flip();
    return silent_;
  }

 private:
  double uniform() { return draws_.uniform(next_++); }
  void flip() {
    silent_ = !silent_;
    until_ += -std::log1p(-uniform()) * (silent_ ? sender_.silent_for : sender_.silent_every);
  }

  const Sender& sender_;
  dsp::RandomAddress draws_;
  std::uint32_t next_ = 0;
  bool silent_ = false;
  Seconds until_;
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

double awake_share(const Sender& sender) {
  if (sender.silent_every.value <= 0) return 1;
  return sender.silent_every / (sender.silent_every + sender.silent_for);
}

dsp::RandomAddress purpose(dsp::RandomAddress draws, std::uint32_t which) {
  draws.purpose += which << 8U;
  return draws;
}

}  // namespace

std::vector<Sender> make_senders(const Scenario& s) {
  std::vector<Sender> senders;
  for (const auto& [name, device] : s.devices) {
    Scatter scatter(static_cast<std::uint64_t>(s.simulation.seed), name);
    for (int number = 1; number <= static_cast<int>(device.count); ++number)
      senders.push_back(make_sender(s, name, device, number, scatter));
  }
  name_draws(s, senders);
  return senders;
}

Seconds frame_time(const Sender& sender, std::size_t bytes) {
  return static_cast<double>(bytes * protocol::bits_per_byte) * dsp::period(sender.baud);
}

Seconds longest_frame(const Sender& sender) {
  return frame_time(sender, std::ranges::max(sizes_of(sender)));
}

double mean_load(const Sender& sender) {
  return awake_share(sender) * (mean_frame(sender) / mean_period(sender));
}

/// Half the data bits of a message are taken as light.
double mean_light(const Sender& sender) {
  constexpr double lit_slots = (1 + protocol::data_bits / 2.0) / protocol::bits_per_byte;
  return sender.duty * lit_slots * mean_load(sender);
}

SentFrames send(const Sender& sender, const dsp::RandomAddress& draws, Seconds end) {
  constexpr double periods_before = 10;
  Pauses pause(sender, purpose(draws, pauses));
  Seconds at = -(periods_before + pause.uniform() * periods_in_turn(sender)) * mean_period(sender);
  MessageQueue queue(sender.source, sender.messages, sender.status_hold, purpose(draws, contents));
  SilentSpells silence(sender, purpose(draws, spells), at);
  SentFrames sent{dsp::LogicTrace(true), {}};
  while (at < end) {
    SentFrame frame{at, at, queue.next(at), silence.silent_at(at)};
    const protocol::Bytes bytes = protocol::cosys_encode(frame.message);
    frame.end = at + frame_time(sender, bytes.size());
    if (frame.end > Seconds(0)) {
      if (!frame.silent)
        for (const std::uint8_t byte : bytes)
          at = protocol::send_byte(sent.drive, byte, at, sender.baud);
      sent.frames.push_back(frame);
    }
    at = frame.end + pause.next();
  }
  return sent;
}

}  // namespace sim
