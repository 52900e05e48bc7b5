#include "sim/command/decoded_capture.hpp"

#include <fmt/format.h>

#include <memory>
#include <span>
#include <vector>

#include "protocol/uart_receivers.hpp"
#include "protocol/uart_stream.hpp"
#include "sim/capture/carrier_demodulator.hpp"
#include "sim/capture/sampled_line.hpp"

namespace sim {
namespace {

using dsp::Hertz;
using dsp::Seconds;

constexpr std::size_t edges_at_once = most_surveyed_edges;

/// The next edges of a line; fewer than a batch at its end alone.
std::vector<Seconds> next_edges(EdgeSource& line, const DecodeListener& listener) {
  constexpr std::size_t told = 1024;  // of so many edges the last: they may be far apart
  std::vector<Seconds> edges;
  while (edges.size() < edges_at_once) {
    const auto edge = line.next();
    if (!edge) break;
    edges.push_back(*edge);
    if (edges.size() % told == 0) listener.reached(*edge);
  }
  return edges;
}

/// A line's characters and messages as it goes on.
class CapturedLineDecoder {
 public:
  CapturedLineDecoder(const DecodeRequest& request, const DecodeListener& listener, bool initial,
                      DecodedCapture& decoded)
      : decoded_(decoded),
        listener_(listener),
        uart_(*protocol::find_uart_receiver(request.uart), decoded.line.baud, 0, initial),
        statistics_(decoded.line.baud, initial),
        frames_(wire_protocol(request.protocol).decoder()) {}

  void take(std::span<const Seconds> edges, Seconds known_until) {
    const auto bytes = uart_.take(edges, known_until);
    statistics_.add(edges, bytes);
    for (const protocol::UartByte& byte : bytes) tell(frames_->push(byte));
  }

  void end() {
    tell(frames_->rest());
    decoded_.fit = statistics_.fit();
    decoded_.characters = statistics_.characters();
    decoded_.framing_errors = statistics_.framing_errors();
  }

 private:
  void tell(const std::optional<WireFrame>& frame) {
    if (!frame) return;
    ++(frame->outcome == "ok" ? decoded_.accepted : decoded_.refused);
    listener_.message(*frame);
  }

  DecodedCapture& decoded_;
  const DecodeListener& listener_;
  protocol::UartStream uart_;
  LineStatistics statistics_;
  std::unique_ptr<WireDecoder> frames_;
};

std::optional<bool> told_inverted(const DecodeRequest& request) {
  if (request.polarity == "auto") return std::nullopt;
  return request.polarity == "idle-low";
}

std::optional<Hertz> hertz(const std::optional<double>& rate) {
  return rate ? std::optional(Hertz(*rate)) : std::nullopt;
}

void decode_line(EdgeSource& line, const DecodeRequest& request, const DecodeListener& listener,
                 DecodedCapture& decoded) {
  std::vector<Seconds> edges = next_edges(line, listener);
  decoded.line = survey_line({line.initial(), edges, line.known_until(), line.resolution()},
                             told_inverted(request), hertz(request.baud));
  listener.chosen(decoded);
  CapturedLineDecoder decoder(request, listener, line.initial() != decoded.line.inverted, decoded);
  std::optional<Seconds> last;
  for (; edges.size() == edges_at_once; edges = next_edges(line, listener)) {
    last = edges.back();
    decoder.take(edges, *last);
  }
  if (!edges.empty()) last = edges.back();
  decoder.take(edges, end_of_line(last, line.known_until(), decoded.line.baud));
  decoder.end();
}

void note_silence(const SampledLine& line, CaptureFacts& facts) {
  const Seconds silence = line.passed_over();
  if (silence == Seconds(0)) return;
  facts.assumed.push_back(fmt::format("nothing in the first {:.4g} s", silence.value));
  if (!line.is_heard())
    facts.doubt =
        "no carrier and no two levels stand out of its noise (nothing was heard, or it is "
        "too weak) say --carrier or --baud";
}

}  // namespace

bool asks_for_many(const DecodeRequest& request) {
  std::error_code ignored;
  return request.captures.size() > 1 ||
         std::filesystem::is_directory(request.captures.front(), ignored);
}

DecodedCapture decode_capture(const std::filesystem::path& path, const DecodeRequest& request,
                              const DecodeListener& listener) {
  const LineHints hints{told_inverted(request), hertz(request.baud), hertz(request.carrier_hz)};
  const Capture capture = open_capture(
      path, {request.wire, hertz(request.sample_rate_hz), request.format, request.sample_bytes,
             request.tick, request.skip_rows, hints, asks_for_many(request)});
  DecodedCapture decoded;
  decoded.file = path.string();
  decoded.read = capture.facts;
  if (capture.logic) {
    WireEdges wire(*capture.logic, capture.wire);
    CarrierDemodulator line(wire, hints.carrier);
    decoded.carrier = line.carrier();
    decode_line(line, request, listener, decoded);
  } else {
    SampledLine line(*capture.samples, {hints.carrier, hints.baud});
    decoded.carrier = line.carrier();
    note_silence(line, decoded.read);
    decode_line(line, request, listener, decoded);
  }
  return decoded;
}

}  // namespace sim
