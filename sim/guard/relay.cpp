#include "sim/guard/relay.hpp"

#include <algorithm>
#include <deque>
#include <optional>

#include "protocol/shared_node.hpp"
#include "sim/threads/parallel_runs.hpp"

namespace sim {
namespace {

using dsp::Seconds;

protocol::SharedNodeSettings node_settings(const RelayDesign& design) {
  return {.full_set_every = Seconds(design.settings.full_set_every_s),
          .query_timeout = Seconds(design.settings.query_timeout_s)};
}

protocol::SharedNode robot_node(const RelayDesign& design) {
  auto settings = node_settings(design);
  settings.outbound = design.variables;
  settings.compressed = design.settings.compressed != 0;
  return protocol::SharedNode(settings);
}

protocol::SharedNode base_node(const RelayDesign& design) {
  auto settings = node_settings(design);
  settings.address = 'B';
  settings.peer = 'A';
  settings.inbound = design.variables;
  return protocol::SharedNode(settings);
}

SerialLine line(const RelayDesign& design, const dsp::RandomAddress& draws, std::uint32_t which) {
  const GuardSettings& s = design.settings;
  dsp::RandomAddress damage = draws, outages = draws;
  damage.purpose += (2 * which) << 8U;
  outages.purpose += (2 * which + 1) << 8U;
  return SerialLine({dsp::Hertz(s.line_baud),
                     s.byte_error_ratio,
                     {Seconds(s.outage_every_s), Seconds(s.outage_for_s)}},
                    damage, outages);
}

/// One message on its way from the robot's table to the base station.
struct Passage {
  bool carried = false, known = false;
};

/// Which message each variable's value was of when bytes were sent.
struct Load {
  std::size_t bytes_left;
  std::vector<std::optional<std::size_t>> messages;
};

class RelayRun {
 public:
  RelayRun(const RelayDesign& design, std::span<const HeardFrame> heard,
           const dsp::RandomAddress& draws, const std::atomic<bool>* stop)
      : design_(design),
        heard_(heard),
        robot_(robot_node(design)),
        base_(base_node(design)),
        unharmed_(base_node(design)),
        down_(line(design, draws, 0)),
        up_(line(design, draws, 1)),
        passages_(heard.size()),
        latest_(design.variables.size()),
        known_(design.variables.size()),
        asked_at_(design.variables.size()),
        stop_(stop) {
    tally_.relays.resize(design.variables.size());
  }

  GuardTally run() {
    const Seconds turn(design_.settings.transmit_every_ms * 1e-3);
    double i = 0;
    for (; i * turn < design_.duration && !is_stopped(stop_); ++i) {
      meet(i * turn);
      look(i * turn);
      robot_turn(i * turn);
      meet((i + 0.5) * turn);
      base_turn((i + 0.5) * turn);
    }
    count_talk();
    for (; !is_settled() && !is_stopped(stop_); ++i) {
      meet(i * turn);
      if (!had_last_set_) robot_turn(i * turn);
    }
    count_messages();
    return std::move(tally_);
  }

 private:
  /// Every message heard has gone over the line or has been replaced: a full set has.
  bool is_settled() const { return had_last_set_ && loads_.empty(); }

  /// From then on the robot's next turn is behind a full set of all that it has heard, or one.
  Seconds last_set() const {
    const Seconds last = heard_.empty() ? Seconds(0) : Seconds(heard_.back().end_s) + design_.delay;
    return std::max(design_.duration, last) + Seconds(design_.settings.full_set_every_s);
  }

  /// All that happens until then.
  void meet(Seconds now) {
    for (; next_ < heard_.size() && Seconds(heard_[next_].end_s) + design_.delay <= now; ++next_)
      hear(next_);
    while (down_.arrived(now)) arrive(down_.take());
    while (up_.arrived(now))
      if (const auto arrival = up_.take(); !arrival.lost) robot_.receive(arrival.byte);
  }

  void hear(std::size_t message) {
    const std::size_t variable = heard_[message].sender;
    latest_[variable] = message;
    [[maybe_unused]] const auto problem = robot_.set(variable, heard_[message].message);
  }

  void robot_turn(Seconds now) {
    if (!down_.is_free(now)) return;
    had_last_set_ = now >= last_set();
    const protocol::Bytes bytes = robot_.transmit(now);
    if (bytes.empty()) return;
    loads_.push_back({bytes.size(), latest_});
    down_.send(bytes, now);
  }

  void base_turn(Seconds now) {
    if (!up_.is_free(now)) return;
    for (std::size_t i = 0; i < asked_at_.size(); ++i)
      if (lacks(i, now)) {
        base_.ask(i);
        asked_at_[i] = now;
      }
    up_.send(base_.transmit(now), now);
  }

  /// Whether the base station has no young value of a device and no question under way.
  bool lacks(std::size_t variable, Seconds now) const {
    const auto& at = base_.inbound()[variable].at;
    const auto& asked = asked_at_[variable];
    return (!at || now - *at >= Seconds(design_.settings.query_age_s)) &&
           (!asked || now - *asked >= Seconds(design_.settings.query_timeout_s));
  }

  void arrive(const SerialLine::Arrival& arrival) {
    const Load& load = loads_.front();
    for (const std::size_t variable : updated(unharmed_, arrival.sent))
      if (const auto message = load.messages[variable]) passages_[*message].carried = true;
    if (!arrival.lost)
      for (const std::size_t variable : updated(base_, arrival.byte))
        learn(variable, load.messages[variable]);
    if (--loads_.front().bytes_left == 0) loads_.pop_front();
  }

  /// Variables whose value the byte brings, changed or not.
  std::vector<std::size_t> updated(protocol::SharedNode& node, const protocol::UartByte& byte) {
    const std::uint64_t accepted = node.counts().accepted;
    node.receive(byte);
    std::vector<std::size_t> variables;
    if (node.counts().accepted == accepted) return variables;
    for (std::size_t i = 0; i < node.inbound().size(); ++i)
      if (node.inbound()[i].at == byte.start) variables.push_back(i);
    return variables;
  }

  /// A value that damage has made another is not known.
  void learn(std::size_t variable, const std::optional<std::size_t>& message) {
    if (!message || base_.inbound()[variable].value != heard_[*message].message) return;
    passages_[*message].known = true;
    known_[variable] = message;
  }

  /// At what the base station knows.
  void look(Seconds now) {
    for (std::size_t i = 0; i < known_.size(); ++i)
      known_[i] ? tally_.relays[i].age.add(now.value - heard_[*known_[i]].start_s)
                : tally_.relays[i].age.add_unknown();
  }

  void count_messages() {
    for (std::size_t i = 0; i < heard_.size(); ++i) {
      RelayTally& relay = tally_.relays[heard_[i].sender];
      ++(passages_[i].known     ? relay.n_known
         : passages_[i].carried ? relay.n_lost
                                : relay.n_replaced);
    }
  }

  /// While the run lasts.
  void count_talk() {
    tally_.n_sent = robot_.counts().sent + base_.counts().sent;
    tally_.n_accepted = robot_.counts().accepted + base_.counts().accepted;
    tally_.n_asked = base_.counts().asked;
    tally_.n_answered = base_.counts().answered;
    tally_.n_timed_out = base_.counts().timed_out;
  }

  const RelayDesign& design_;
  std::span<const HeardFrame> heard_;
  protocol::SharedNode robot_, base_;
  protocol::SharedNode unharmed_;  // a base station on a line without damage
  SerialLine down_, up_;           // robot to base station and back
  std::deque<Load> loads_;
  std::vector<Passage> passages_;                           // of each that was heard
  std::size_t next_ = 0;                                    // to be heard
  std::vector<std::optional<std::size_t>> latest_, known_;  // of each variable: which message
  std::vector<std::optional<Seconds>> asked_at_;
  bool had_last_set_ = false;
  const std::atomic<bool>* stop_;
  GuardTally tally_;
};

}  // namespace

GuardTally relay(const RelayDesign& design, std::span<const HeardFrame> heard,
                 const dsp::RandomAddress& draws, const std::atomic<bool>* stop) {
  return RelayRun(design, heard, draws, stop).run();
}

}  // namespace sim
