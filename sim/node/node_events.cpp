#include "sim/node/node_events.hpp"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "sim/escaped_text.hpp"
#include "sim/standard_output.hpp"

namespace sim {
namespace {

using Json = nlohmann::ordered_json;
using Counts = protocol::SharedNodeCounts;

struct NamedCount {
  const char* name;
  std::uint64_t Counts::*member;
};

/// Of messages, or what is in them, that the node can do nothing with.
constexpr std::array<NamedCount, 7> misfits{{{"for_others", &Counts::for_others},
                                             {"from_others", &Counts::from_others},
                                             {"from_self", &Counts::from_self},
                                             {"bad_index", &Counts::bad_index},
                                             {"misplaced", &Counts::misplaced},
                                             {"unknown_asked", &Counts::unknown_asked},
                                             {"unknown_replies", &Counts::unknown_replies}}};

constexpr std::array<NamedCount, 5> others{{{"sent", &Counts::sent},
                                            {"accepted", &Counts::accepted},
                                            {"asked", &Counts::asked},
                                            {"answered", &Counts::answered},
                                            {"timed_out", &Counts::timed_out}}};

std::string_view outcome_name(std::size_t outcome) {
  return name(static_cast<protocol::SharedLinkOutcome>(outcome));
}

Json event_at(dsp::Seconds now, std::string_view event) {
  return {{"time_s", std::round(now.value * 1e6) / 1e6}, {"event", event}};
}

void print_line(const Json& line) { print(line.dump() + "\n"); }

void print_refusal(dsp::Seconds now, std::string_view reason, const std::string& message) {
  Json line = event_at(now, "rejected");
  line["reason"] = reason;
  line["message"] = escaped(message);
  print_line(line);
}

Json rejections(const Counts& counts) {
  Json all = Json::object();
  for (std::size_t outcome = 1; outcome < counts.rejected.size(); ++outcome)
    all[std::string(outcome_name(outcome))] = counts.rejected[outcome];
  return all;
}

}  // namespace

void print_ready(dsp::Seconds now, const std::string& port, const NodeFile& file) {
  Json line = event_at(now, "ready");
  line["device"] = port;
  line["address"] = std::string(1, file.settings.address);
  line["peer"] = std::string(1, file.settings.peer);
  line["baud"] = static_cast<std::uint64_t>(file.baud.value);
  print_line(line);
}

void print_value(dsp::Seconds now, std::string_view event,
                 const protocol::SharedVariable& variable) {
  Json line = event_at(now, event);
  line["name"] = variable.name;
  line["value"] = variable.value;
  print_line(line);
}

void print_timed_out(dsp::Seconds now, const std::string& name) {
  Json line = event_at(now, "timed_out");
  line["name"] = name;
  print_line(line);
}

void print_port_event(dsp::Seconds now, std::string_view event) {
  print_line(event_at(now, event));
}

void print_own_address(dsp::Seconds now, const std::string& message) {
  Json line = event_at(now, "own_address");
  line["message"] = escaped(message);
  print_line(line);
}

void print_misfits(dsp::Seconds now, const Counts& before, const Counts& after,
                   const std::string& message) {
  for (std::size_t outcome = 1; outcome < after.rejected.size(); ++outcome)
    if (after.rejected[outcome] != before.rejected[outcome])
      print_refusal(now, outcome_name(outcome), message);
  for (const auto& [name, member] : misfits)
    if (member != &Counts::from_self && after.*member != before.*member)
      print_refusal(now, name, message);
}

void print_end(dsp::Seconds now, std::string_view reason, const Counts& node,
               const PortCounts& port) {
  Json line = event_at(now, "end");
  line["reason"] = reason;
  line["bytes_received"] = port.bytes_received;
  line["bytes_sent"] = port.bytes_sent;
  for (const auto& [name, member] : others) line[name] = node.*member;
  line["dropped"] = port.dropped;
  line["rejected"] = rejections(node);
  for (const auto& [name, member] : misfits) line[name] = node.*member;
  print_line(line);
}

}  // namespace sim
