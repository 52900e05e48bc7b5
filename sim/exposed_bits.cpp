#include "sim/exposed_bits.hpp"

namespace sim {
namespace {

void add_character(std::vector<ExposedBit>& bits, const Link& link, dsp::Seconds start,
                   std::uint8_t byte) {
  const dsp::Seconds bit = dsp::period(link.device_baud);
  for (int slot = 0; slot < protocol::bits_per_byte; ++slot)
    bits.push_back({start + bit * slot, start + bit * (slot + 1), !protocol::line_bit(byte, slot)});
}

}  // namespace

std::vector<std::vector<ExposedBit>> exposed_bits(const Link& link, const Transmission& sent) {
  std::vector<std::vector<ExposedBit>> parts;
  const std::size_t n = sent.messages.size();
  if (n > 1)
    add_character(parts.emplace_back(), link, sent.messages[n - 2].byte_start.back(),
                  link.bytes.back());
  std::vector<ExposedBit>& counted = parts.emplace_back();
  for (std::size_t i = 0; i < link.bytes.size(); ++i)
    add_character(counted, link, sent.messages.back().byte_start[i], link.bytes[i]);
  return parts;
}

}  // namespace sim
