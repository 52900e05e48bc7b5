// One run of an exchange: two nodes, two chains, and a clock that both go by.
#include <algorithm>
#include <deque>
#include <utility>
#include <vector>

#include "channel/live_chain.hpp"
#include "sim/link/disturbance.hpp"
#include "sim/shared_link/node_draws.hpp"
#include "sim/shared_link/shared_link.hpp"
#include "sim/shared_link/station.hpp"

namespace sim {
namespace {

using dsp::Seconds;

/// What a chain starts from: nothing keyed yet, other lights whole, until `end`.
channel::ChainInput chain_start(const SharedLinkSetup& setup, std::uint32_t run, std::size_t node,
                                Seconds end) {
  const auto phases = draws_of(setup, run, node, NodeDraws::phases).block(0);
  channel::ChainInput input{.drive = nullptr,
                            .carrier_phase = phases[0],
                            .noise_seed = draws_of(setup, run, node, NodeDraws::noise).block(0)};
  input.disturbances.push_back({.phase = {phases[1], 0}, .drive = dsp::LogicTrace(true)});
  dsp::RandomAddress lights = draws_of(setup, run, node, NodeDraws::lights);
  for (const DisturbanceSettings& disturbance : setup.disturbances) {
    input.disturbances.push_back(draw_disturbance(disturbance, lights, end));
    lights.purpose += 1U << 16U;
  }
  return input;
}

void count_bits(const SharedLinkSetup& setup, const Station& from, const Station& to,
                DirectionTally& tally) {
  dsp::TraceReader reader(to.pin());
  for (const SentByte& byte : from.sent()) {
    const Seconds bit = dsp::period(setup.baud);
    if (byte.start + protocol::bits_per_byte * bit + setup.delay > to.pin().end()) return;
    for (int slot = 0; slot < protocol::bits_per_byte; ++slot) {
      const bool heard = reader.level_at(byte.start + (slot + 0.5) * bit + setup.delay);
      ++tally.n_bits;
      tally.n_bit_errors += heard != protocol::line_bit(byte.value, slot);
    }
  }
}

DirectionTally direction(const SharedLinkSetup& setup, const Station& from, const Station& to) {
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
  count_bits(setup, from, to, tally);
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
  Pair(const SharedLinkSetup& setup, std::uint32_t run, channel::LiveChains& chains,
       std::size_t chain)
      : setup_(setup),
        end_(setup.settings.duration_s),
        a_(setup, run, 0, chains, chain),
        b_(setup, run, 1, chains, chain + 1) {}

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

  SharedLinkTally tally() const {
    const auto ab = direction(setup_, a_, b_), ba = direction(setup_, b_, a_);
    ClusterSums losses;
    losses.add(ab.losses.part + ba.losses.part, ab.losses.whole + ba.losses.whole);
    return {.direction = {ab, ba}, .losses = losses, .n_runs = 1};
  }

 private:
  const SharedLinkSetup& setup_;
  Seconds end_;
  Station a_, b_;
};

std::vector<channel::ChainInput> chain_starts(const SharedLinkSetup& setup, std::uint32_t first,
                                              std::uint32_t n) {
  // What was sent when time is up arrives.
  const Seconds end = Seconds(setup.settings.duration_s) + longest_turn(setup) + 2 * settling;
  std::vector<channel::ChainInput> starts;
  for (std::uint32_t run = first; run < first + n; ++run)
    for (const std::size_t node : {0U, 1U}) starts.push_back(chain_start(setup, run, node, end));
  return starts;
}

/// Runs whose chains have lanes, all by one clock.
SharedLinkTally run_together(const SharedLinkSetup& setup, std::uint32_t first, std::uint32_t n,
                             const std::atomic<bool>* stop) {
  const auto starts = chain_starts(setup, first, n);
  channel::LiveChains chains(setup.chain, starts);
  std::deque<Pair> pairs;
  for (std::uint32_t i = 0; i < n; ++i) pairs.emplace_back(setup, first + i, chains, 2 * i);
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
  SharedLinkTally sum;
  for (const Pair& pair : pairs) sum += pair.tally();
  return sum;
}

}  // namespace

SharedLinkTally run_shared_link(const SharedLinkSetup& setup, std::uint32_t first, int n,
                                const std::atomic<bool>* stop) {
  const auto at_once = static_cast<std::uint32_t>(channel::trials_at_once()) / 2;
  const std::uint32_t end = first + static_cast<std::uint32_t>(n);
  SharedLinkTally sum;
  for (std::uint32_t run = first; run < end; run += at_once)
    sum += run_together(setup, run, std::min(at_once, end - run), stop);
  return sum;
}

}  // namespace sim
