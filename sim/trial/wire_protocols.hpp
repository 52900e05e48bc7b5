#pragma once
// The message formats that encode and decode know, a row each. A format is a pair of files in
// protocol/; what stands here is how people write and read its messages.
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/uart.hpp"

namespace sim {

struct WireFrame {
  std::optional<dsp::Seconds> start;  // nothing: of what was heard last and has not ended
  std::string outcome;                // "ok", or why not
  std::string message;                // as encode takes it if ok, else as received
};

/// Makes frames of bytes as they come, in bounded memory.
class WireDecoder {
 public:
  WireDecoder() = default;
  WireDecoder(const WireDecoder&) = delete;
  WireDecoder& operator=(const WireDecoder&) = delete;
  virtual ~WireDecoder() = default;

  /// The frame that this byte completes, if it does.
  virtual std::optional<WireFrame> push(const protocol::UartByte& byte) = 0;
  /// What has begun and not ended: a newline that is damaged would hide a whole message.
  virtual std::optional<WireFrame> rest() const = 0;
};

struct WireProtocol {
  std::string_view name;
  /// Throws bad_input for what cannot be sent.
  protocol::Bytes (*encode)(const std::string& message);
  std::unique_ptr<WireDecoder> (*decoder)();
};

std::vector<std::string> wire_protocol_names();

/// That of one of these names.
const WireProtocol& wire_protocol(std::string_view name);

}  // namespace sim
