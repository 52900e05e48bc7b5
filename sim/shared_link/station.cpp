#include "sim/shared_link/station.hpp"

namespace sim {
namespace {

using dsp::Seconds;

std::vector<std::string> variable_names(char node, const SharedLinkSettings& settings) {
  std::vector<std::string> names;
  for (int i = 1; i <= static_cast<int>(settings.variables); ++i)
    names.push_back(std::string(1, node) + std::to_string(i));
  return names;
}

protocol::SharedNodeSettings node_settings(const SharedLinkSetup& setup, std::size_t node) {
  const SharedLinkSettings& s = setup.settings;
  const char self = node == 0 ? 'A' : 'B', other = node == 0 ? 'B' : 'A';
  return {.address = self,
          .peer = other,
          .outbound = variable_names(self, s),
          .inbound = variable_names(other, s),
          .compressed = s.compressed != 0,
          .full_set_every = Seconds(s.full_set_every_s),
          .query_timeout = Seconds(s.query_timeout_s)};
}

/// Has a value for each variable, and a question.
protocol::SharedNode full_node(const SharedLinkSetup& setup, std::size_t which) {
  protocol::SharedNode node(node_settings(setup, which));
  const std::string longest(static_cast<std::size_t>(setup.settings.value_characters), '0');
  for (std::size_t i = 0; i < node.outbound().size(); ++i) {
    [[maybe_unused]] const auto problem = node.set(i, longest);
    node.ask(i);
  }
  return node;
}

}  // namespace

Seconds longest_turn(const SharedLinkSetup& setup) {
  protocol::SharedNode a = full_node(setup, 0), b = full_node(setup, 1);
  for (const std::uint8_t byte : b.transmit(Seconds(0))) a.receive({Seconds(0), byte, false});
  return static_cast<double>(a.transmit(Seconds(0)).size()) *
         (protocol::bits_per_byte * dsp::period(setup.baud));
}

Station::Station(const SharedLinkSetup& setup, std::uint32_t run, std::size_t which,
                 channel::LiveChains& chains, std::size_t chain)
    : setup_(setup),
      node_(node_settings(setup, which)),
      chains_(chains),
      chain_(chain),
      uart_(*setup.uart, setup.receiver_baud,
            draws_of(setup, run, which, NodeDraws::uart).uniform(0)),
      pauses_(draws_of(setup, run, which, NodeDraws::pauses)),
      changes_(draws_of(setup, run, which, NodeDraws::changes)),
      queries_(draws_of(setup, run, which, NodeDraws::queries)),
      change_at_(node_.outbound().size()),
      told_at_(node_.inbound().size()),
      ages_(node_.inbound().size()) {
  next_turn_ = pause();
  next_query_ = queries_.exponential(Seconds(setup.settings.query_every_s));
}

void Station::hear(const std::optional<Seconds>& others_turn) {
  for (const protocol::UartByte& byte : uart_.take(pin())) {
    if (byte.start >= busy_until_) last_heard_ = byte.start;
    receive(byte, others_turn);
  }
}

/// A line begins with a bracket, be it its own, the other's or noise.
void Station::receive(const protocol::UartByte& byte, const std::optional<Seconds>& others_turn) {
  const protocol::SharedNodeCounts before = node_.counts();
  node_.receive(byte);
  const protocol::SharedNodeCounts& now = node_.counts();
  if (now.accepted > before.accepted) note(byte.start, others_turn);
  SharedLinkReasons& refused = line_is_own_ ? own_damaged_ : rejected_;
  for (std::size_t i = 0; i < refused.size(); ++i)
    refused[i] += now.rejected[i] - before.rejected[i];
  if (byte.value == '[') line_is_own_ = is_own(byte.start);
}

bool Station::is_own(Seconds start) const {
  return last_turn_ && *last_turn_ <= start && start < busy_until_;
}

void Station::live(Seconds now) {
  for (std::size_t i = 0; i < change_at_.size(); ++i) {
    if (now < change_at_[i]) continue;
    change_at_[i] = now + changes_.exponential(Seconds(setup_.settings.change_every_s));
    [[maybe_unused]] const auto problem = node_.set(i, new_value());
  }
  if (setup_.settings.query_every_s <= 0 || now < next_query_) return;
  next_query_ = now + queries_.exponential(Seconds(setup_.settings.query_every_s));
  node_.ask(queries_.index(node_.inbound().size()));
}

void Station::look(Seconds now) {
  for (std::size_t i = 0; i < told_at_.size(); ++i)
    told_at_[i] ? ages_[i].add((now - *told_at_[i]).value) : ages_[i].add_unknown();
}

bool Station::has_turn(Seconds now) const {
  return now >= next_turn_ && now >= busy_until_ &&
         (!last_heard_ ||
          now - *last_heard_ >= Seconds(setup_.settings.quiet_ms * 1e-3) +
                                    protocol::bits_per_byte * dsp::period(setup_.baud));
}

std::optional<dsp::LogicTrace> Station::turn(Seconds now) {
  const protocol::Bytes bytes = node_.transmit(now);
  dsp::LogicTrace drive(true);
  Seconds at = now;
  for (const std::uint8_t byte : bytes) {
    sent_.push_back({at, byte});
    at = protocol::send_byte(drive, byte, at, setup_.baud);
  }
  next_turn_ = at + pause();
  if (bytes.empty()) return std::nullopt;
  last_turn_ = now;
  busy_until_ = at;
  chains_.key_disturbance(chain_, own_reflection, drive);
  return drive;
}

Seconds Station::pause() {
  const SharedLinkSettings& s = setup_.settings;
  return Seconds((s.interval_min_ms + pauses_.uniform() * (s.interval_max_ms - s.interval_min_ms)) *
                 1e-3);
}

std::string Station::new_value() {
  std::string value;
  for (int i = 0; i < static_cast<int>(setup_.settings.value_characters); ++i)
    value += static_cast<char>('0' + changes_.index(10));
  return value;
}

/// Values that the message which ended at `at` has brought are as old as the other's turn.
void Station::note(Seconds at, const std::optional<Seconds>& others_turn) {
  for (std::size_t i = 0; i < told_at_.size(); ++i)
    if (node_.inbound()[i].at == at) told_at_[i] = others_turn;
}

}  // namespace sim
