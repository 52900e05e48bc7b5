#pragma once
// One end of a SharedLink: an outbound list of named variables, which the peer mirrors, and an
// inbound list, which mirrors the peer's. A pure state machine: bytes and the time go in, bytes and
// changed variables come out. It has no clock, no thread and no port.
//
// A value that has not changed is sent as an empty field, so no value is empty. The sum of a
// message finds every byte that is changed, lost or added, but not all pairs of them: what passes
// is taken.
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "dsp/units.hpp"
#include "protocol/shared_link.hpp"

namespace protocol {

struct SharedNodeSettings {
  char address = 'A', peer = 'B';
  std::vector<std::string> outbound{}, inbound{};  // names, known to both ends beforehand
  bool compressed = true;  // leave out what has not changed, but for full sets
  dsp::Seconds full_set_every{1};
  dsp::Seconds query_timeout{1};
  /// On the line. 0: what is transmitted has left at once, and no answer waits for another.
  dsp::Seconds byte_time{0};
  std::size_t max_size = default_max_shared_link;  // of a message, bytes
};

/// Why there can be no such node, if there cannot.
std::optional<std::string> problem_in_node(const SharedNodeSettings& settings);

struct SharedVariable {
  std::string name;
  std::string value{};               // empty: not yet known
  std::optional<dsp::Seconds> at{};  // when it was heard last, changed or not
};

/// What happened to a node.
struct SharedNodeCounts {
  std::uint64_t sent = 0;      // messages
  std::uint64_t accepted = 0;  // messages, that is: none of the following
  std::array<std::uint64_t, shared_link_outcomes> rejected{};  // by SharedLinkOutcome
  std::uint64_t for_others = 0;                                // to another address
  std::uint64_t from_others = 0;                               // not from the peer
  std::uint64_t from_self = 0;  // from this node's own address: another has it too, or an echo
  std::uint64_t bad_index = 0;  // no number, or a value outside of the list
  std::uint64_t misplaced = 0;  // a value with neither index nor name, or a name without a value
  std::uint64_t unknown_asked = 0;    // queries that were not answered: no such value here
  std::uint64_t unknown_replies = 0;  // values of a name that is not in the list
  std::uint64_t asked = 0, answered = 0, timed_out = 0;  // queries of this node's own
  std::uint64_t answered_late = 0;                       // of those that timed out
};

/// What a byte brings.
struct SharedNodeNews {
  std::vector<std::size_t> changed;   // inbound variables with another value
  std::vector<std::size_t> answered;  // those that were asked for, changed or not
  std::vector<std::size_t> late;      // ... but given up before
  std::string text;                   // of the message that ends here, between its brackets
};

class SharedNode {
 public:
  /// The settings must have no problem.
  explicit SharedNode(SharedNodeSettings settings);

  /// Why this cannot be sent as a value of an outbound variable, if it cannot.
  std::optional<std::string> problem_in_value(std::size_t variable, const std::string& value) const;
  /// A new value of an outbound variable; why it cannot be sent, if it cannot.
  [[nodiscard]] std::optional<std::string> set(std::size_t variable, const std::string& value);
  /// Asks the peer for an inbound variable, as soon as those asked for before leave time for it.
  /// Asked again before an answer, it is said again and stays the one question that it was.
  void ask(std::size_t variable);

  /// What is to be sent now: answers, queries for about a second, and values: all where a full set
  /// is due, else those that have changed.
  Bytes transmit(dsp::Seconds now);
  /// What was transmitted last was not heard, for a reason known here: a full set is due at once.
  void resend() { full_set_at_.reset(); }
  SharedNodeNews receive(const UartByte& byte);
  /// The inbound variables whose query has waited too long since it has left, or since one that was
  /// asked for before was answered: a peer answers in order. The node waits for them no longer, and
  /// has counted them. transmit() and receive() do so too.
  std::vector<std::size_t> give_up(dsp::Seconds now);

  const std::vector<SharedVariable>& outbound() const { return outbound_; }
  const std::vector<SharedVariable>& inbound() const { return inbound_; }
  const SharedNodeCounts& counts() const { return counts_; }

 private:
  struct Query {
    std::size_t variable;
    dsp::Seconds since;  // when its time began
  };
  struct Content;
  class ContentReader;

  std::optional<Content> content_of(const SharedLinkMessage& message);
  void take(const Content& content, dsp::Seconds now, SharedNodeNews& news);
  void take_reply(std::size_t variable, dsp::Seconds now, SharedNodeNews& news);
  void answer(const std::vector<std::string>& names);
  SharedLinkMessage to_peer() const { return {settings_.peer, settings_.address, {}}; }
  void append(Bytes& bytes, const SharedLinkMessage& message);
  void append_answers(Bytes& bytes);
  void append_queries(Bytes& bytes, dsp::Seconds now);
  void append_values(Bytes& bytes, bool full);

  SharedNodeSettings settings_;
  SharedLinkDecoder decoder_;
  std::vector<SharedVariable> outbound_, inbound_;
  std::vector<bool> changed_;           // of the outbound ones, since they were sent
  std::vector<std::size_t> to_answer_;  // outbound variables
  std::vector<std::size_t> to_ask_;     // inbound ones
  std::vector<Query> asked_;            // in the order of asking
  std::vector<bool> given_up_;          // inbound ones, since they were asked for
  std::optional<dsp::Seconds> full_set_at_;
  SharedNodeCounts counts_;
};

}  // namespace protocol
