#include "sim/arena/sender.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <cmath>

#include "protocol/cosys.hpp"
#include "sim/failure.hpp"
#include "sim/link/link.hpp"
#include "sim/text/list_text.hpp"
#include "sim/text/number_text.hpp"

namespace sim {
namespace {

using dsp::Seconds;

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
  sender.pulse = Seconds(s.device.pulse_us * 1e-6);
  sender.source = find_message_source(d.source);
  sender.messages = messages_of(name, d, number);
  sender.status_hold = Seconds(d.status_hold_s);
  sender.interval_min = Seconds(d.interval_min_ms * 1e-3);
  sender.interval_max = Seconds(d.interval_max_ms * 1e-3);
  sender.intervals = intervals_of(d);
  sender.silence = {Seconds(d.silent_every_s), Seconds(d.silent_for_s)};
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

}  // namespace sim
