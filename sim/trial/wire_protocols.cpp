#include "sim/trial/wire_protocols.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "protocol/cosys.hpp"
#include "protocol/shared_link.hpp"
#include "sim/failure.hpp"

namespace sim {
namespace {

using Frames = std::vector<WireFrame>;
using HeardBytes = std::span<const protocol::UartByte>;

// ---- COSYS ----

protocol::Bytes encode_cosys(const std::string& message) {
  if (const auto problem = protocol::problem_in_message(message))
    throw bad_input(
        "the message cannot be sent", *problem,
        fmt::format("use printable ASCII, at most {} characters", protocol::longest_message));
  return protocol::cosys_encode(message);
}

/// What was heard behind the last newline too: one that is damaged would hide a whole message.
Frames decode_cosys(HeardBytes bytes) {
  Frames frames;
  protocol::CosysDecoder decoder;
  for (const protocol::UartByte& byte : bytes)
    if (const auto frame = decoder.push(byte))
      frames.push_back({frame->start, std::string(name(frame->outcome)), frame->message});
  if (!decoder.pending().empty()) frames.push_back({{}, "no newline", decoder.pending()});
  return frames;
}

// ---- SharedLink ----

protocol::Bytes encode_shared_link(const std::string& text) {
  protocol::SharedLinkMessage message;
  auto problem = protocol::parse_shared_link(text, message);
  if (!problem) problem = protocol::problem_in_message(message);
  if (problem)
    throw bad_input("the message cannot be sent", *problem,
                    "write it from its addresses on, such as 'AB|N0|D40.1|D85.6'");
  return protocol::shared_link_encode(message);
}

WireFrame shared_link_frame(const protocol::SharedLinkFrame& frame) {
  const bool ok = frame.outcome == protocol::SharedLinkOutcome::ok;
  return {frame.start, std::string(name(frame.outcome)),
          ok ? protocol::shared_link_text(frame.message) : frame.text};
}

Frames decode_shared_link(HeardBytes bytes) {
  Frames frames;
  protocol::SharedLinkDecoder decoder;
  for (const protocol::UartByte& byte : bytes)
    if (const auto frame = decoder.push(byte)) frames.push_back(shared_link_frame(*frame));
  if (const std::string* text = decoder.pending()) frames.push_back({{}, "no bracket", *text});
  return frames;
}

constexpr std::array<WireProtocol, 2> protocols{
    {{"cosys", encode_cosys, decode_cosys},
     {"sharedlink", encode_shared_link, decode_shared_link}}};

}  // namespace

std::vector<std::string> wire_protocol_names() {
  std::vector<std::string> names;
  for (const WireProtocol& protocol : protocols) names.emplace_back(protocol.name);
  return names;
}

const WireProtocol& wire_protocol(std::string_view name) {
  return *std::ranges::find(protocols, name, &WireProtocol::name);
}

}  // namespace sim
