#include <fmt/format.h>

#include "protocol/cosys.hpp"
#include "protocol/soft_decoder.hpp"
#include "protocol/uart_receivers.hpp"
#include "sim/check/decoder.hpp"
#include "sim/text/escaped_text.hpp"
#include "sim/text/list_text.hpp"

namespace sim {
namespace {

/// A UART and the plain decoder behind it.
class UartDecoder : public Decoder {
 public:
  explicit UartDecoder(const protocol::UartReceiver& uart) : uart_(uart), name_(uart.name) {}

  const std::string& name() const override { return name_; }

  Decoded decode(const DelimitedStream& line) const override {
    Decoded decoded;
    protocol::CosysDecoder decoder;
    for (const protocol::UartByte& byte : characters(line)) {
      auto frame = decoder.push(byte);
      if (frame && frame->outcome == protocol::CosysOutcome::ok)
        decoded.accepted.push_back(std::move(frame->message));
    }
    return decoded;
  }

  std::vector<protocol::UartByte> characters(const DelimitedStream& line) const override {
    return uart_.receive(line.wire, line.baud, 0);
  }

 private:
  const protocol::UartReceiver& uart_;
  std::string name_;
};

/// All that is known of the protocol, used.
class WholeLineDecoder : public Decoder {
 public:
  WholeLineDecoder(std::string name, protocol::SoftMemory memory)
      : name_(std::move(name)), memory_(memory) {}

  const std::string& name() const override { return name_; }

  Decoded decode(const DelimitedStream& line) const override {
    Decoded decoded;
    for (protocol::SoftMessage& message : protocol::decode_soft(line.wire, line.baud, memory_))
      decoded.accepted.push_back(std::move(message.message));
    return decoded;
  }

 private:
  std::string name_;
  protocol::SoftMemory memory_;
};

constexpr const char* soft = "soft";
constexpr const char* soft_alone = "soft-alone";  // what is told apart from what was heard before

}  // namespace

std::string last_line_of(const std::string& words) {
  std::string line;
  for (const std::string_view one : split(words, '\n'))
    if (!trimmed(one).empty()) line = escaped(trimmed(one));
  return line.empty() ? "it said nothing" : line;
}

std::string fault_line(const std::string& decoder, const std::string& place,
                       const DecoderFault& fault) {
  return fmt::format("{} failed at {}: {} ({})\n", decoder, place, fault.what,
                     last_line_of(fault.words));
}

std::vector<std::string> built_in_decoders() {
  std::vector<std::string> names;
  for (const protocol::UartReceiver& uart : protocol::uart_receivers())
    names.emplace_back(uart.name);
  names.insert(names.end(), {soft, soft_alone});
  return names;
}

std::unique_ptr<Decoder> make_built_in_decoder(const std::string& name) {
  if (name == soft)
    return std::make_unique<WholeLineDecoder>(name, protocol::SoftMemory::of_messages);
  if (name == soft_alone)
    return std::make_unique<WholeLineDecoder>(name, protocol::SoftMemory::none);
  const protocol::UartReceiver* uart = protocol::find_uart_receiver(name);
  return uart == nullptr ? nullptr : std::make_unique<UartDecoder>(*uart);
}

}  // namespace sim
