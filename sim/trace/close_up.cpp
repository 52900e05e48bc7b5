#include "sim/trace/close_up.hpp"

#include <fmt/format.h>

namespace sim {
namespace {

constexpr double cycles_from_cause = 25;  // the module answers after 7 to 15
constexpr double cycles_beyond = 5;

std::string bit_name(int slot) {
  if (slot == 0) return "start bit";
  return slot == protocol::stop_slot ? "stop bit" : fmt::format("bit {}", slot - 1);
}

CloseUp at_beginning(double edge_s, double cycle_s, const std::string& of) {
  return {.edge_s = edge_s,
          .from_s = edge_s - cycles_beyond * cycle_s,
          .to_s = edge_s + cycles_from_cause * cycle_s,
          .edge = "The beginning of its " + of};
}

CloseUp at_pin(double edge_s, double cycle_s, const std::string& of) {
  return {.edge_s = edge_s,
          .from_s = edge_s - cycles_from_cause * cycle_s,
          .to_s = edge_s + cycles_beyond * cycle_s,
          .edge = "The pin's edge in its " + of};
}

/// Of the pin, between two instants.
std::optional<double> last_edge(const dsp::LogicTrace& pin, double from_s, double to_s) {
  std::optional<double> last;
  for (const dsp::Seconds edge : pin.edges())
    if (edge.value > from_s && edge.value <= to_s) last = edge.value;
  return last;
}

}  // namespace

CloseUp close_up_of(const TracedTrial& trial, const TracedMessage& message) {
  const std::size_t character = message.first_wrong().value_or(0);
  const double bit_s = message.character_s / protocol::bits_per_byte;
  const double cycle_s = 1 / trial.carrier.value, start_s = message.start_s(character);
  for (int slot = 0; slot < protocol::bits_per_byte; ++slot) {
    if (!is_wrong_at_pin(trial, message, character, slot)) continue;
    const double from_s = start_s + slot * bit_s, at_pin_s = from_s + trial.delay.value;
    const std::string of = bit_name(slot) + ", which is misread";
    const auto edge_s = last_edge(trial.rx, at_pin_s, at_pin_s + bit_s / 2);
    return edge_s ? at_pin(*edge_s, cycle_s, of) : at_beginning(from_s, cycle_s, of);
  }
  return at_beginning(start_s, cycle_s, bit_name(0));
}

}  // namespace sim
