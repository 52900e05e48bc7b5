// One run of an exchange: two nodes, two chains, and a clock that both go by.
#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>
#include <string>
#include <utility>

#include "channel/live_chain.hpp"
#include "protocol/shared_node.hpp"
#include "protocol/uart_stream.hpp"
#include "sim/disturbance.hpp"
#include "sim/exchange/exchange.hpp"
#include "sim/trial.hpp"

namespace sim {
namespace {

using dsp::Seconds;

constexpr Seconds tick(10e-3);  // of a node's processor
constexpr std::size_t reflection = 0;

/// Draws of one node for one thing; a node has eight.
enum class NodeDraws : std::uint32_t { pauses, changes, queries, noise, phases, uart, lights };

dsp::RandomAddress draws_of(const Exchange& exchange, std::uint32_t run, std::size_t node,
                            NodeDraws what) {
  const auto which = static_cast<std::uint32_t>(node * 8) + static_cast<std::uint32_t>(what);
  return {.seed = exchange.seed,
          .point = exchange.point,
          .trial = run,
          .purpose = static_cast<std::uint32_t>(Purpose::shared_node) + (which << 8U)};
}

/// Uniform and exponential numbers, one after the other.
class Draws {
 public:
  explicit Draws(const dsp::RandomAddress& address) : address_(address) {}
  double uniform() { return address_.uniform(next_++); }
  Seconds exponential(double mean_s) { return Seconds(-std::log1p(-uniform()) * mean_s); }

 private:
  dsp::RandomAddress address_;
  std::uint32_t next_ = 0;
};

std::vector<std::string> variable_names(char node, const ExchangeSettings& settings) {
  std::vector<std::string> names;
  for (int i = 1; i <= static_cast<int>(settings.variables); ++i)
    names.push_back(std::string(1, node) + std::to_string(i));
  return names;
}

protocol::SharedNodeSettings node_settings(const Exchange& exchange, std::size_t node) {
  const ExchangeSettings& s = exchange.settings;
  const char self = node == 0 ? 'A' : 'B', other = node == 0 ? 'B' : 'A';
  return {.address = self,
          .peer = other,
          .outbound = variable_names(self, s),
          .inbound = variable_names(other, s),
          .compressed = s.compressed != 0,
          .full_set_every = Seconds(s.full_set_every_s),
          .query_timeout = Seconds(s.query_timeout_s)};
}

/// A character on the air, for who counts bit errors.
struct SentByte {
  Seconds start;
  std::uint8_t value;
};

/// What a chain starts from: nothing keyed yet, other lights whole.
channel::ChainInput chain_start(const Exchange& exchange, std::uint32_t run, std::size_t node) {
  const Seconds end(2 * exchange.settings.duration_s);  // and longer than what goes on behind it
  const auto phases = draws_of(exchange, run, node, NodeDraws::phases).block(0);
  channel::ChainInput input{.drive = nullptr,
                            .carrier_phase = phases[0],
                            .noise_seed = draws_of(exchange, run, node, NodeDraws::noise).block(0)};
  input.disturbances.push_back({.phase = {phases[1], 0}, .drive = dsp::LogicTrace(true)});
  dsp::RandomAddress lights = draws_of(exchange, run, node, NodeDraws::lights);
  for (const DisturbanceSettings& disturbance : exchange.disturbances) {
    input.disturbances.push_back(draw_disturbance(disturbance, lights, end));
    lights.purpose += 1U << 16U;
  }
  return input;
}

/// A node with its processor, its LED and its receiver.
class Station {
 public:
  /// `which` of the two of a run; `chain`: its place among the chains.
  Station(const Exchange& exchange, std::uint32_t run, std::size_t which,
          channel::LiveChains& chains, std::size_t chain)
      : exchange_(exchange),
        node_(node_settings(exchange, which)),
        chains_(chains),
        chain_(chain),
        uart_(*exchange.uart, exchange.receiver_baud,
              draws_of(exchange, run, which, NodeDraws::uart).uniform(0)),
        pauses_(draws_of(exchange, run, which, NodeDraws::pauses)),
        changes_(draws_of(exchange, run, which, NodeDraws::changes)),
        queries_(draws_of(exchange, run, which, NodeDraws::queries)),
        change_at_(node_.outbound().size()),
        told_at_(node_.inbound().size()) {
    next_turn_ = pause();
    next_query_ = queries_.exponential(exchange.settings.query_every_s);
  }

  /// Hears what its chain has by now. `others_turn`: when the other began to send last.
  void hear(const std::optional<Seconds>& others_turn) {
    for (const protocol::UartByte& byte : uart_.take(pin())) {
      if (byte.start >= busy_until_) last_heard_ = byte.start;
      const std::uint64_t accepted = node_.counts().accepted;
      node_.receive(byte);
      if (node_.counts().accepted > accepted) note(byte.start, others_turn);
    }
  }

  /// The world changes what it has to tell; it wonders what the other has.
  void live(Seconds now) {
    for (std::size_t i = 0; i < change_at_.size(); ++i) {
      if (now < change_at_[i]) continue;
      change_at_[i] = now + changes_.exponential(exchange_.settings.change_every_s);
      [[maybe_unused]] const auto problem = node_.set(i, new_value());
    }
    if (exchange_.settings.query_every_s <= 0 || now < next_query_) return;
    next_query_ = now + queries_.exponential(exchange_.settings.query_every_s);
    node_.ask(
        static_cast<std::size_t>(queries_.uniform() * static_cast<double>(node_.inbound().size())));
  }

  /// Whether it may send now.
  bool has_turn(Seconds now) const {
    return now >= next_turn_ && now >= busy_until_ &&
           (!last_heard_ ||
            now - *last_heard_ >= Seconds(exchange_.settings.quiet_ms * 1e-3) +
                                      protocol::bits_per_byte * dsp::period(exchange_.baud));
  }

  /// Whether it sends, or has just sent.
  bool is_busy(Seconds now) const { return now < busy_until_ + 5 * tick; }

  /// The wire of its LED from now on, if there is something to say.
  std::optional<dsp::LogicTrace> turn(Seconds now) {
    const protocol::Bytes bytes = node_.transmit(now);
    dsp::LogicTrace drive(true);
    Seconds at = now;
    for (const std::uint8_t byte : bytes) {
      sent_.push_back({at, byte});
      at = protocol::send_byte(drive, byte, at, exchange_.baud);
    }
    next_turn_ = at + pause();
    if (bytes.empty()) return std::nullopt;
    last_turn_ = now;
    busy_until_ = at;
    chains_.key_disturbance(chain_, reflection, drive);
    return drive;
  }

  void see(const dsp::LogicTrace& light) { chains_.key(chain_, light); }

  /// At how old what it holds is.
  void look(Seconds now) {
    for (const auto& at : told_at_) at ? age_.add((now - *at).value) : age_.add_unknown();
  }

  const protocol::SharedNode& node() const { return node_; }
  const std::optional<Seconds>& last_turn() const { return last_turn_; }
  const std::vector<SentByte>& sent() const { return sent_; }
  const dsp::LogicTrace& pin() const { return chains_.pin(chain_); }
  const AgeCounts& age() const { return age_; }

 private:
  Seconds pause() {
    const ExchangeSettings& s = exchange_.settings;
    return Seconds(
        (s.interval_min_ms + pauses_.uniform() * (s.interval_max_ms - s.interval_min_ms)) * 1e-3);
  }

  std::string new_value() {
    std::string value;
    for (int i = 0; i < static_cast<int>(exchange_.settings.value_characters); ++i)
      value += static_cast<char>('0' + static_cast<int>(changes_.uniform() * 10));
    return value;
  }

  /// Values that the message which ended at `at` has brought are as old as the other's turn.
  void note(Seconds at, const std::optional<Seconds>& others_turn) {
    for (std::size_t i = 0; i < told_at_.size(); ++i)
      if (node_.inbound()[i].at == at) told_at_[i] = others_turn;
  }

  const Exchange& exchange_;
  protocol::SharedNode node_;
  channel::LiveChains& chains_;
  std::size_t chain_;
  protocol::UartStream uart_;
  Draws pauses_, changes_, queries_;
  std::vector<Seconds> change_at_;
  std::vector<std::optional<Seconds>> told_at_;  // of each inbound variable
  Seconds next_turn_, next_query_, busy_until_;
  std::optional<Seconds> last_heard_, last_turn_;
  std::vector<SentByte> sent_;
  AgeCounts age_;
};

void count_bits(const Exchange& exchange, const Station& from, const Station& to,
                DirectionTally& tally) {
  dsp::TraceReader reader(to.pin());
  for (const SentByte& byte : from.sent()) {
    const Seconds bit = dsp::period(exchange.baud);
    if (byte.start + protocol::bits_per_byte * bit + exchange.delay > to.pin().end()) return;
    for (int slot = 0; slot < protocol::bits_per_byte; ++slot) {
      const bool heard = reader.level_at(byte.start + (slot + 0.5) * bit + exchange.delay);
      ++tally.n_bits;
      tally.n_bit_errors += heard != protocol::line_bit(byte.value, slot);
    }
  }
}

DirectionTally direction(const Exchange& exchange, const Station& from, const Station& to) {
  const protocol::SharedNodeCounts& mine = from.node().counts();
  DirectionTally tally{.n_sent = mine.sent,
                       .n_accepted = to.node().counts().accepted,
                       .n_asked = mine.asked,
                       .n_answered = mine.answered,
                       .n_timed_out = mine.timed_out,
                       .n_own = mine.from_self,
                       .rejected = to.node().counts().rejected,
                       .age = to.age()};
  count_bits(exchange, from, to, tally);
  return tally;
}

/// Who has its turn first gets it; at the same tick both do, and collide.
void take_turns(Station& a, Station& b, Seconds now) {
  const bool a_may = a.has_turn(now), b_may = b.has_turn(now);
  if (a_may)
    if (const auto light = a.turn(now)) b.see(*light);
  if (b_may)
    if (const auto light = b.turn(now)) a.see(*light);
}

/// The two stations of a run.
class Pair {
 public:
  Pair(const Exchange& exchange, std::uint32_t run, channel::LiveChains& chains, std::size_t chain)
      : exchange_(exchange),
        end_(exchange.settings.duration_s),
        a_(exchange, run, 0, chains, chain),
        b_(exchange, run, 1, chains, chain + 1) {}

  /// When all that was sent has arrived, nothing more is looked at.
  bool goes_on(Seconds now) const { return now < end_ || a_.is_busy(now) || b_.is_busy(now); }

  void step(Seconds now) {
    a_.hear(b_.last_turn());
    b_.hear(a_.last_turn());
    if (now >= end_) return;
    for (Station* station : {&a_, &b_}) {
      station->live(now);
      station->look(now);
    }
    take_turns(a_, b_, now);
  }

  ExchangeTally tally() const {
    return {.direction = {direction(exchange_, a_, b_), direction(exchange_, b_, a_)}, .n_runs = 1};
  }

 private:
  const Exchange& exchange_;
  Seconds end_;
  Station a_, b_;
};

std::vector<channel::ChainInput> chain_starts(const Exchange& exchange, std::uint32_t first,
                                              std::uint32_t n) {
  std::vector<channel::ChainInput> starts;
  for (std::uint32_t run = first; run < first + n; ++run)
    for (const std::size_t node : {0U, 1U}) starts.push_back(chain_start(exchange, run, node));
  return starts;
}

/// Runs whose chains have lanes, all by one clock.
ExchangeTally run_together(const Exchange& exchange, std::uint32_t first, std::uint32_t n,
                           const std::atomic<bool>* stop) {
  const auto starts = chain_starts(exchange, first, n);
  channel::LiveChains chains(exchange.chain, starts);
  std::deque<Pair> pairs;
  for (std::uint32_t i = 0; i < n; ++i) pairs.emplace_back(exchange, first + i, chains, 2 * i);
  bool going = true;
  for (int i = 0; going && (stop == nullptr || !*stop); ++i) {
    const Seconds now = i * tick;
    chains.advance(now);
    going = false;
    for (Pair& pair : pairs) {
      if (!pair.goes_on(now)) continue;
      pair.step(now);
      going = true;
    }
  }
  ExchangeTally sum;
  for (const Pair& pair : pairs) sum += pair.tally();
  return sum;
}

}  // namespace

ExchangeTally run_exchange(const Exchange& exchange, std::uint32_t first, int n,
                           const std::atomic<bool>* stop) {
  const auto at_once = static_cast<std::uint32_t>(channel::trials_at_once()) / 2;
  const std::uint32_t end = first + static_cast<std::uint32_t>(n);
  ExchangeTally sum;
  for (std::uint32_t run = first; run < end; run += at_once)
    sum += run_together(exchange, run, std::min(at_once, end - run), stop);
  return sum;
}

}  // namespace sim
