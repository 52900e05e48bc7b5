#include "sim/trial/wire_protocols.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "protocol/cosys.hpp"
#include "protocol/shared_link.hpp"
#include "sim/failure.hpp"

namespace sim {
namespace {

using HeardFrame = std::optional<WireFrame>;

// ---- COSYS ----

protocol::Bytes encode_cosys(const std::string& message) {
  if (const auto problem = protocol::problem_in_message(message))
    throw bad_input(
        "the message cannot be sent", *problem,
        fmt::format("use printable ASCII, at most {} characters", protocol::longest_message));
  return protocol::cosys_encode(message);
}

class CosysWire : public WireDecoder {
 public:
  HeardFrame push(const protocol::UartByte& byte) override {
    const auto frame = decoder_.push(byte);
    if (!frame) return std::nullopt;
    return WireFrame{frame->start, std::string(name(frame->outcome)), frame->message};
  }
  HeardFrame rest() const override {
    if (decoder_.pending().empty()) return std::nullopt;
    return WireFrame{{}, "no newline", decoder_.pending()};
  }

 private:
  protocol::CosysDecoder decoder_;
};

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

class SharedLinkWire : public WireDecoder {
 public:
  HeardFrame push(const protocol::UartByte& byte) override {
    const auto frame = decoder_.push(byte);
    return frame ? HeardFrame(shared_link_frame(*frame)) : std::nullopt;
  }
  HeardFrame rest() const override {
    const std::string* text = decoder_.pending();
    return text != nullptr ? HeardFrame(WireFrame{{}, "no bracket", *text}) : std::nullopt;
  }

 private:
  protocol::SharedLinkDecoder decoder_;
};

template <class Decoder>
std::unique_ptr<WireDecoder> make_decoder() {
  return std::make_unique<Decoder>();
}

constexpr std::array<WireProtocol, 2> protocols{
    {{"cosys", encode_cosys, make_decoder<CosysWire>},
     {"sharedlink", encode_shared_link, make_decoder<SharedLinkWire>}}};

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
