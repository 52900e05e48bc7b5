#include "sim/counting/tally.hpp"

namespace sim {

Tally& Tally::operator+=(const Tally& o) {
  n_bits += o.n_bits;
  n_bit_errors += o.n_bit_errors;
  n_bytes += o.n_bytes;
  n_byte_errors += o.n_byte_errors;
  n_framing_errors += o.n_framing_errors;
  n_frames += o.n_frames;
  n_frames_ok += o.n_frames_ok;
  n_frames_lost += o.n_frames_lost;
  n_frames_undetected += o.n_frames_undetected;
  n_frames_false += o.n_frames_false;
  n_frames_unheard += o.n_frames_unheard;
  n_frames_unended += o.n_frames_unended;
  n_rejected_unprintable += o.n_rejected_unprintable;
  n_rejected_short += o.n_rejected_short;
  n_rejected_not_hex += o.n_rejected_not_hex;
  n_rejected_checksum += o.n_rejected_checksum;
  n_rejected_overlong += o.n_rejected_overlong;
  n_frames_bit_errors += o.n_frames_bit_errors;
  sum_bit_errors_squared += o.sum_bit_errors_squared;
  sum_bits_squared += o.sum_bits_squared;
  sum_bit_errors_times_bits += o.sum_bit_errors_times_bits;
  weighted += o.weighted;
  return *this;
}

}  // namespace sim
