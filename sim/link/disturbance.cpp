#include "sim/link/disturbance.hpp"

#include <algorithm>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "channel/ambient.hpp"
#include "dsp/random_stream.hpp"
#include "protocol/cosys.hpp"
#include "protocol/shared_link.hpp"
#include "protocol/uart.hpp"
#include "sim/scenario/disturbance_keys.hpp"

namespace sim {
namespace {

using dsp::Hertz;
using dsp::Seconds;

Seconds ms(double milliseconds) { return Seconds(milliseconds * 1e-3); }

dsp::WattsPerSquareMetre irradiance(const DisturbanceSettings& d) {
  const DisturbanceKind& kind = kind_of(d);
  return kind.light_of_lux ? kind.light_of_lux(d.lux)
                           : dsp::WattsPerSquareMetre(d.irradiance_w_per_m2);
}

/// Moreira's model as it is, of visible light; of a lamp by its lux the lines of the ballast are as
/// deep as they are in the infrared.
channel::FluorescentLight fluorescent_light(const DisturbanceSettings& d) {
  const double line = channel::fluorescent_line(2, d.ballast_db_per_decade);
  return {.mean = irradiance(d),
          .mains = Hertz(d.mains_hz),
          .ballast = Hertz(d.ballast_hz),
          .decibels_per_decade = d.ballast_db_per_decade,
          .ballast_share = kind_of(d).light_of_lux ? d.modulation_depth / line : 1};
}

void light_from(dsp::LogicTrace& drive, Seconds from, Seconds duration) {
  drive.set_at(from, false);
  drive.set_at(from + duration, true);
}

// ---- remote control ----

Seconds mean_light(const DisturbanceSettings& d) { return ms(d.leader_ms + d.bursts * d.burst_ms); }

void send_remote_frame(dsp::LogicTrace& drive, const DisturbanceSettings& d, Seconds at,
                       dsp::RandomStream& draws) {
  if (d.leader_ms > 0) {
    light_from(drive, at, ms(d.leader_ms));
    at += ms(d.leader_ms + d.leader_gap_ms);
  }
  for (int i = 0; i < static_cast<int>(d.bursts); ++i) {
    light_from(drive, at, ms(d.burst_ms));
    at += ms(d.burst_ms + (draws.uniform() < 0.5 ? d.gap_min_ms : d.gap_max_ms));
  }
}

dsp::LogicTrace remote_drive(const DisturbanceSettings& d, dsp::RandomStream& draws, Seconds end) {
  dsp::LogicTrace drive(true);
  Seconds at = -draws.uniform() * ms(d.repetition_ms);
  for (; at < end; at += ms(d.repetition_ms)) send_remote_frame(drive, d, at, draws);
  return drive;
}

// ---- what sends characters ----

/// A value of two digits, a point and four digits, and so of one length; `digit()` gives each.
std::string value_text(const std::function<char()>& digit) {
  std::string text;
  for (const char place : std::string_view("00.0000")) text += place == '.' ? place : digit();
  return text;
}

/// All variables of a list in one message, of node B to node A.
protocol::Bytes shared_link_line(const DisturbanceSettings& d, const std::function<char()>& digit) {
  using enum protocol::SharedLinkFieldType;
  protocol::SharedLinkMessage message{.destination = 'A', .source = 'B', .fields = {{index, "0"}}};
  for (int i = 0; i < static_cast<int>(d.variables); ++i)
    message.fields.push_back({data, value_text(digit)});
  return protocol::shared_link_encode(message);
}

/// The next message, whose values are drawn if it has any.
protocol::Bytes next_message(const DisturbanceSettings& d, dsp::RandomStream& draws) {
  if (d.kind == "cosys") return protocol::cosys_encode(d.message);
  return shared_link_line(d, [&] { return static_cast<char>('0' + draws.index(10)); });
}

/// Messages that together have each digit as often as another: the first if it is always the same.
std::vector<protocol::Bytes> typical_messages(const DisturbanceSettings& d) {
  if (d.kind == "cosys") return {protocol::cosys_encode(d.message)};
  std::vector<protocol::Bytes> lines;
  for (char digit = '0'; digit <= '9'; ++digit)
    lines.push_back(shared_link_line(d, [=] { return digit; }));
  return lines;
}

Seconds message_time(const protocol::Bytes& bytes, double baud) {
  return Seconds(static_cast<double>(bytes.size()) * protocol::bits_per_byte / baud);
}

/// All messages of a sender are as long.
Seconds mean_period(const DisturbanceSettings& d) {
  return message_time(typical_messages(d).front(), d.baud) +
         ms((d.interval_min_ms + d.interval_max_ms) / 2);
}

/// It starts so early that time 0 falls anywhere into its rhythm.
dsp::LogicTrace message_drive(const DisturbanceSettings& d, dsp::RandomStream& draws, Seconds end) {
  constexpr double periods_before = 10;
  dsp::LogicTrace drive(true);
  Seconds at = -(periods_before + draws.uniform()) * mean_period(d);
  while (at < end) {
    for (const std::uint8_t byte : next_message(d, draws))
      at = protocol::send_byte(drive, byte, at, Hertz(d.baud));
    at += ms(d.interval_min_ms + draws.uniform() * (d.interval_max_ms - d.interval_min_ms));
  }
  return drive;
}

/// How many bits of a message are light, on average.
double mean_zeros(const DisturbanceSettings& d) {
  double zeros = 0;
  const std::vector<protocol::Bytes> messages = typical_messages(d);
  for (const protocol::Bytes& bytes : messages)
    zeros += static_cast<double>(std::ranges::count(protocol::line_bits(bytes), false));
  return zeros / static_cast<double>(messages.size());
}

/// Share of time in which a sender's carrier is on.
double keyed_share(const DisturbanceSettings& d) {
  if (d.kind == "remote") return mean_light(d) / ms(d.repetition_ms);
  if (!sends_characters(d)) return 1;
  return mean_zeros(d) / d.baud / mean_period(d).value;
}

}  // namespace

bool sends_characters(const DisturbanceSettings& d) {
  return d.kind == "cosys" || d.kind == "sharedlink";
}

bool is_keyed(const DisturbanceSettings& d) { return kind_of(d).wave == LightWave::keyed; }

dsp::WattsPerSquareMetre mean_of(const DisturbanceSettings& d) {
  return is_keyed(d) ? irradiance(d) * (d.carrier_duty * keyed_share(d)) : irradiance(d);
}

dsp::WattsPerSquareMetre ambient_of(const Scenario& s) {
  dsp::WattsPerSquareMetre sum = dsp::WattsPerSquareMetre(s.ambient.irradiance_w_per_m2) +
                                 channel::daylight(s.ambient.daylight_lux) +
                                 channel::tungsten_light(s.ambient.tungsten_lux);
  for (const auto& [name, disturbance] : s.disturbances) sum += mean_of(disturbance);
  return sum;
}

channel::Disturbance design_disturbance(const DisturbanceSettings& d, Hertz rate) {
  switch (kind_of(d).wave) {
    case LightWave::steady:
      return {};
    case LightWave::ripple:
      return channel::design_ripple(irradiance(d), Hertz(d.mains_hz), d.modulation_depth, rate);
    case LightWave::fluorescent:
      return channel::design_fluorescent(fluorescent_light(d), rate);
    case LightWave::pulses:
      return channel::design_pwm(irradiance(d), Hertz(d.frequency_hz), d.duty, rate);
    case LightWave::keyed:
      break;
  }
  return channel::design_keyed_light(irradiance(d), Hertz(d.carrier_hz), d.carrier_duty, rate);
}

channel::DisturbanceInput draw_disturbance(const DisturbanceSettings& d,
                                           const dsp::RandomAddress& draws, Seconds end) {
  dsp::RandomStream next(draws);
  const auto phases = next.block();
  channel::DisturbanceInput input{.phase = {phases[0], phases[1]}};
  if (d.kind == "remote") input.drive = remote_drive(d, next, end);
  if (sends_characters(d)) input.drive = message_drive(d, next, end);
  if (d.kind == "carrier") input.drive = dsp::LogicTrace(false, end);
  return input;
}

Seconds longest_frame(const DisturbanceSettings& d) {
  const double leader = d.leader_ms > 0 ? d.leader_ms + d.leader_gap_ms : 0;
  return ms(leader + d.bursts * (d.burst_ms + std::max(d.gap_min_ms, d.gap_max_ms)));
}

}  // namespace sim
