// One run of an exchange: two nodes, two chains, and a clock that both go by.
#include <algorithm>
#include <deque>
#include <utility>
#include <vector>

#include "channel/live_chain.hpp"
#include "sim/exchange/exchange.hpp"
#include "sim/exchange/node_draws.hpp"
#include "sim/exchange/station.hpp"
#include "sim/link/disturbance.hpp"

namespace sim {
namespace {

using dsp::Seconds;

/// What a chain starts from: nothing keyed yet, other lights whole, until `end`.
channel::ChainInput chain_start(const Exchange& exchange, std::uint32_t run, std::size_t node,
                                Seconds end) {
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
                       .own_damaged = from.own_damaged(),
                       .rejected = to.rejected(),
                       .variable_ages = to.ages()};
  tally.losses.add(tally.n_sent - std::min(tally.n_accepted, tally.n_sent), tally.n_sent);
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
    const auto ab = direction(exchange_, a_, b_), ba = direction(exchange_, b_, a_);
    ClusterSums losses;
    losses.add(ab.losses.part + ba.losses.part, ab.losses.whole + ba.losses.whole);
    return {.direction = {ab, ba}, .losses = losses, .n_runs = 1};
  }

 private:
  const Exchange& exchange_;
  Seconds end_;
  Station a_, b_;
};

std::vector<channel::ChainInput> chain_starts(const Exchange& exchange, std::uint32_t first,
                                              std::uint32_t n) {
  // What was sent when time is up arrives.
  const Seconds end = Seconds(exchange.settings.duration_s) + longest_turn(exchange) + 2 * settling;
  std::vector<channel::ChainInput> starts;
  for (std::uint32_t run = first; run < first + n; ++run)
    for (const std::size_t node : {0U, 1U}) starts.push_back(chain_start(exchange, run, node, end));
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
    const Seconds now = i * processor_tick;
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
