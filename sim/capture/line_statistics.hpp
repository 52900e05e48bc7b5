#pragma once
// How well a line keeps to its bit rate, measured at the edges of the characters read from it.
//
// Of the edges of a character, edge i at time e_i belongs to the beginning of bit slot k_i (0 the
// start bit, 9 the stop bit), and r_i is 1 where light ends there and 0 where it begins. Over all
// characters without a framing error whose edges are just those of their byte, least squares fit
//   e_i = c + T k_i + d r_i,   with an origin c of each character's own:
//   baud        1 / T
//   distortion  d, by which pulses of light are longer than whole bits (pulse-width distortion)
//   jitter      rms of the residuals, their sum of squares divided by the degrees of freedom:
//               edges - characters - 2
// Noise that is wide enough to add or remove edges is in the framing errors and in the frames, not
// in these. Memory is that of the edges since the last character.
#include <cstdint>
#include <deque>
#include <optional>
#include <span>

#include "dsp/units.hpp"
#include "protocol/uart.hpp"

namespace sim {

struct LineFit {
  dsp::Hertz baud;
  dsp::Seconds distortion, jitter;
};

class LineStatistics {
 public:
  /// `baud` is what the receiver reads with, `initial` the line's level before its first edge (1 is
  /// dark).
  LineStatistics(dsp::Hertz baud, bool initial) : baud_(baud), level_(initial) {}

  /// The edges since the last call, and the characters that were read from all edges so far.
  void add(std::span<const dsp::Seconds> edges, std::span<const protocol::UartByte> bytes);

  std::uint64_t characters() const { return characters_; }
  std::uint64_t framing_errors() const { return framing_errors_; }
  /// Nothing where the edges do not determine it: fewer than four free, or all in the same slots.
  std::optional<LineFit> fit() const;

 private:
  struct Edge {
    dsp::Seconds at;
    bool rising;
  };

  void add_byte(const protocol::UartByte& byte);
  void forget_before(dsp::Seconds start);
  void add_edges(const protocol::UartByte& byte);

  dsp::Hertz baud_;
  bool level_;
  std::deque<Edge> edges_;
  std::uint64_t characters_ = 0, framing_errors_ = 0;
  // Sums over edges of products of slot k, rising r and excess x = e - k / baud, all less their
  // means in the character.
  double edge_count_ = 0, fitted_ = 0;
  double kk_ = 0, kr_ = 0, rr_ = 0, kx_ = 0, rx_ = 0, xx_ = 0;
};

}  // namespace sim
