#pragma once
// What is judged: a decoder of COSYS messages, built in or a program of the user's.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "protocol/uart.hpp"
#include "sim/check/delimited_stream.hpp"

namespace sim {

/// How a decoder failed to do its work, which is no frame loss.
struct DecoderFault {
  enum class Kind { timeout, killed, exit_code, garbage };

  Kind kind = Kind::garbage;
  std::string what;   // "exit code 2"
  std::string words;  // the end of what it said on stderr
};

/// The last line of what a decoder said, for a line of ours: "sh: 1: mine: not found".
std::string last_line_of(const std::string& words);

/// A line: "mine failed at receiver.range_m = 2 m: it ended with exit code 1 (last line)".
std::string fault_line(const std::string& decoder, const std::string& place,
                       const DecoderFault& fault);

struct Decoded {
  std::vector<std::string> accepted;  // device messages whose checksum was right, in order
  std::optional<DecoderFault> fault;
};

class Decoder {
 public:
  Decoder() = default;
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;
  virtual ~Decoder() = default;

  /// As the user named it.
  virtual const std::string& name() const = 0;
  /// From any thread.
  virtual Decoded decode(const DelimitedStream& line) const = 0;
  /// The characters that it received, where it says them.
  virtual std::vector<protocol::UartByte> characters(const DelimitedStream&) const { return {}; }
};

/// Names of the decoders that the program brings.
std::vector<std::string> built_in_decoders();
/// Null if there is none of that name.
std::unique_ptr<Decoder> make_built_in_decoder(const std::string& name);

}  // namespace sim
