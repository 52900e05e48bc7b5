#include "sim/page/trial_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/trace/traced_message.hpp"

namespace sim {
namespace {

/// "-" where nothing was.
std::string read_at(const TracedMessage& message, std::size_t character) {
  for (const protocol::UartByte& byte : message.received)
    if (message.place_of(byte) == character) return shown(byte);
  return "-";
}

int wrong_bits(const TracedTrial& trial, const TracedMessage& message, std::size_t character) {
  int wrong = 0;
  for (int slot = 0; slot < protocol::bits_per_byte; ++slot)
    wrong += is_wrong_at_pin(trial, message, character, slot);
  return wrong;
}

/// How far apart light and dark are at one instant of all bits.
struct Opening {
  float least_light = std::numeric_limits<float>::infinity();
  float greatest_dark = -std::numeric_limits<float>::infinity();
};

/// Where dark reaches as high as light, of its bit or of the next, there is none.
std::string opening_text(const Opening& eye) {
  const float opening = eye.least_light - eye.greatest_dark;
  return opening > 0 ? fmt::format("{:.3g}", opening) : "closed";
}

Opening opening_at(const TracedTrial& trial, const TracedMessage& message, double phase) {
  const double bit_s = message.character_s / protocol::bits_per_byte;
  const std::vector<float>& integrator = trial.taps.integrator;
  Opening opening;
  for (const protocol::UartByte& byte : message.sent)
    for (int slot = 0; slot < protocol::bits_per_byte; ++slot) {
      const double at_s = byte.start.value + (slot + phase) * bit_s;
      const auto sample = static_cast<std::size_t>(std::llround(at_s * trial.sample_rate.value));
      if (sample >= integrator.size()) continue;
      if (protocol::line_bit(byte.value, slot))
        opening.greatest_dark = std::max(opening.greatest_dark, integrator[sample]);
      else
        opening.least_light = std::min(opening.least_light, integrator[sample]);
    }
  return opening;
}

}  // namespace

PageTable characters_table(const TracedTrial& trial) {
  const TracedMessage message = message_of(trial);
  PageTable table{.head = {"character", "begins [ms]", "sent", "read", "wrong bits"}, .rows = {}};
  for (std::size_t i = 0; i < message.sent.size(); ++i)
    table.rows.push_back({std::to_string(i + 1),
                          fmt::format("{:.2f}", 1e3 * (message.start_s(i) - message.start_s(0))),
                          shown(message.sent[i]), read_at(message, i),
                          std::to_string(wrong_bits(trial, message, i))});
  return table;
}

PageTable eye_table(const TracedTrial& trial) {
  constexpr int steps_a_bit = 8;
  const TracedMessage message = message_of(trial);
  PageTable table{.head = {"bits since the sender's bit began", "light, at least [samples]",
                           "dark, at most [samples]", "opening [samples]"},
                  .rows = {}};
  for (int step = 0; step <= steps_a_bit; ++step) {
    const double phase = static_cast<double>(step) / steps_a_bit;
    const Opening eye = opening_at(trial, message, phase);
    table.rows.push_back({fmt::format("{:g}", phase), fmt::format("{:.3g}", eye.least_light),
                          fmt::format("{:.3g}", eye.greatest_dark), opening_text(eye)});
  }
  return table;
}

}  // namespace sim
