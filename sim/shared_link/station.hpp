#pragma once
// A node of an exchange with its processor, its LED and its receiver. In each tick it hears what
// its pin has by then, the world changes what it has to tell, and it sends if it has its turn.
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "channel/live_chain.hpp"
#include "dsp/logic_trace.hpp"
#include "dsp/random_stream.hpp"
#include "dsp/units.hpp"
#include "protocol/shared_node.hpp"
#include "protocol/uart_stream.hpp"
#include "sim/counting/age_counts.hpp"
#include "sim/shared_link/node_draws.hpp"
#include "sim/shared_link/shared_link.hpp"

namespace sim {

inline constexpr dsp::Seconds processor_tick(10e-3);
inline constexpr dsp::Seconds settling = 5 * processor_tick;  // from a turn's end to its last byte

/// Of the longest turn that a node can have: a question and an answer for each variable, and all
/// values.
dsp::Seconds longest_turn(const SharedLinkSetup& setup);

/// A character on the air, for who counts bit errors.
struct SentByte {
  dsp::Seconds start;
  std::uint8_t value;
};

class Station {
 public:
  /// `which` of the two of a run; `chain`: its place among the chains. Both must outlive this.
  Station(const SharedLinkSetup& setup, std::uint32_t run, std::size_t which,
          channel::LiveChains& chains, std::size_t chain);

  /// Hears what its chain has by now. `others_turn`: when the other began to send last.
  void hear(const std::optional<dsp::Seconds>& others_turn);
  /// The world changes what it has to tell; it wonders what the other has.
  void live(dsp::Seconds now);
  /// At how old each value is that it holds.
  void look(dsp::Seconds now);

  /// Whether it may send now.
  bool has_turn(dsp::Seconds now) const;
  /// Whether it sends, or has just sent.
  bool is_busy(dsp::Seconds now) const { return now < busy_until_ + settling; }
  /// The wire of its LED from now on, if there is something to say.
  std::optional<dsp::LogicTrace> turn(dsp::Seconds now);
  /// Light of the other from now on.
  void see(const dsp::LogicTrace& light) { chains_.key(chain_, light); }

  const protocol::SharedNode& node() const { return node_; }
  /// Lines refused that began while this node was sending, and the others.
  const SharedLinkReasons& own_damaged() const { return own_damaged_; }
  const SharedLinkReasons& rejected() const { return rejected_; }
  const std::optional<dsp::Seconds>& last_turn() const { return last_turn_; }
  const std::vector<SentByte>& sent() const { return sent_; }
  const dsp::LogicTrace& pin() const { return chains_.pin(chain_); }
  const std::vector<AgeCounts>& ages() const { return ages_; }

 private:
  dsp::Seconds pause();
  std::string new_value();
  bool is_own(dsp::Seconds start) const;
  void receive(const protocol::UartByte& byte, const std::optional<dsp::Seconds>& others_turn);
  void note(dsp::Seconds at, const std::optional<dsp::Seconds>& others_turn);

  const SharedLinkSetup& setup_;
  protocol::SharedNode node_;
  channel::LiveChains& chains_;
  std::size_t chain_;
  protocol::UartStream uart_;
  dsp::RandomStream pauses_, changes_, queries_;
  std::vector<dsp::Seconds> change_at_;
  std::vector<std::optional<dsp::Seconds>> told_at_;  // of each inbound variable
  dsp::Seconds next_turn_, next_query_, busy_until_;
  std::optional<dsp::Seconds> last_heard_, last_turn_;
  std::vector<SentByte> sent_;
  bool line_is_own_ = false;  // began while this node sent
  SharedLinkReasons own_damaged_{}, rejected_{};
  std::vector<AgeCounts> ages_;  // of each inbound variable
};

}  // namespace sim
