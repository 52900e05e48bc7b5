#include "sim/node/node_events.hpp"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "sim/text/escaped_text.hpp"

namespace sim {
namespace {

using Json = nlohmann::ordered_json;
using Counts = protocol::SharedNodeCounts;

struct NamedCount {
  const char* name;
  std::uint64_t Counts::*member;
};

/// Of messages, or what is in them, that the node can do nothing with.
constexpr std::array<NamedCount, 7> misfit_counts{{{"for_others", &Counts::for_others},
                                                   {"from_others", &Counts::from_others},
                                                   {"from_self", &Counts::from_self},
                                                   {"bad_index", &Counts::bad_index},
                                                   {"misplaced", &Counts::misplaced},
                                                   {"unknown_asked", &Counts::unknown_asked},
                                                   {"unknown_replies", &Counts::unknown_replies}}};

constexpr std::array<NamedCount, 6> other_counts{{{"sent", &Counts::sent},
                                                  {"accepted", &Counts::accepted},
                                                  {"asked", &Counts::asked},
                                                  {"answered", &Counts::answered},
                                                  {"timed_out", &Counts::timed_out},
                                                  {"answered_late", &Counts::answered_late}}};

std::string_view outcome_name(std::size_t outcome) {
  return name(static_cast<protocol::SharedLinkOutcome>(outcome));
}

Json event_at(dsp::Seconds now, std::string_view event) {
  return {{"time_s", std::round(now.value * 1e6) / 1e6}, {"event", event}};
}

/// Names of ports are any bytes.
std::string text_of(const Json& line) {
  return line.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string lost_events(dsp::Seconds now, std::uint64_t n) {
  Json line = event_at(now, "lost");
  line["events"] = n;
  return text_of(line);
}

Json rejections(const Counts& counts) {
  Json all = Json::object();
  for (std::size_t outcome = 1; outcome < counts.rejected.size(); ++outcome)
    all[std::string(outcome_name(outcome))] = counts.rejected[outcome];
  return all;
}

}  // namespace

void NodeEvents::say(dsp::Seconds now, const std::string& line) {
  if (output_.has_room()) return say_in_any_case(now, line);
  ++lost_;
  ++all_lost_;
}

void NodeEvents::say_in_any_case(dsp::Seconds now, const std::string& line) {
  if (const std::uint64_t n = std::exchange(lost_, 0); n != 0) output_.push(lost_events(now, n));
  output_.push(line);
}

void NodeEvents::refuse(dsp::Seconds now, std::string_view reason, const std::string& message) {
  Json line = event_at(now, "rejected");
  line["reason"] = reason;
  line["message"] = escaped(message);
  say(now, text_of(line));
}

void NodeEvents::ready(dsp::Seconds now, const std::string& port, const NodeFile& file) {
  Json line = event_at(now, "ready");
  line["device"] = port;
  line["address"] = std::string(1, file.settings.address);
  line["peer"] = std::string(1, file.settings.peer);
  line["baud"] = static_cast<std::uint64_t>(file.baud.value);
  say(now, text_of(line));
}

void NodeEvents::value(dsp::Seconds now, std::string_view event,
                       const protocol::SharedVariable& variable) {
  Json line = event_at(now, event);
  line["name"] = variable.name;
  line["value"] = variable.value;
  say(now, text_of(line));
}

void NodeEvents::timed_out(dsp::Seconds now, const std::string& name) {
  Json line = event_at(now, "timed_out");
  line["name"] = name;
  say(now, text_of(line));
}

void NodeEvents::port(dsp::Seconds now, std::string_view event) {
  say(now, text_of(event_at(now, event)));
}

void NodeEvents::own_address(dsp::Seconds now, const std::string& message) {
  Json line = event_at(now, "own_address");
  line["message"] = escaped(message);
  say(now, text_of(line));
}

void NodeEvents::misfits(dsp::Seconds now, const Counts& before, const Counts& after,
                         const std::string& message) {
  for (std::size_t outcome = 1; outcome < after.rejected.size(); ++outcome)
    if (after.rejected[outcome] != before.rejected[outcome])
      refuse(now, outcome_name(outcome), message);
  for (const auto& [name, member] : misfit_counts)
    if (member != &Counts::from_self && after.*member != before.*member) refuse(now, name, message);
}

void NodeEvents::end(dsp::Seconds now, std::string_view reason, const Counts& node,
                     const PortCounts& port) {
  Json line = event_at(now, "end");
  line["reason"] = reason;
  line["bytes_received"] = port.bytes_received;
  line["bytes_sent"] = port.bytes_sent;
  for (const auto& [name, member] : other_counts) line[name] = node.*member;
  line["dropped"] = port.dropped;
  line["events_lost"] = all_lost_;
  line["rejected"] = rejections(node);
  for (const auto& [name, member] : misfit_counts) line[name] = node.*member;
  say_in_any_case(now, text_of(line));
}

}  // namespace sim
