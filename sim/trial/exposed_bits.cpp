#include "sim/trial/exposed_bits.hpp"

namespace sim {
namespace {

/// Characters before the end of a line that a UART mostly takes to be in step again; errors before
/// them are drawn, but more rarely.
constexpr std::size_t last_characters = 3;
constexpr double early_share = 0.1;

void add_character(std::vector<ExposedBit>& bits, const Link& link, dsp::Seconds start,
                   std::uint8_t byte, double share) {
  const dsp::Seconds bit = dsp::period(link.device_baud);
  for (int slot = 0; slot < protocol::bits_per_byte; ++slot)
    bits.push_back(
        {start + bit * slot, start + bit * (slot + 1), !protocol::line_bit(byte, slot), share});
}

}  // namespace

std::vector<std::vector<ExposedBit>> exposed_bits(const Link& link, const Transmission& sent) {
  std::vector<std::vector<ExposedBit>> parts;
  const std::size_t n = sent.messages.size();
  const std::size_t end = link.bytes.size();
  if (n > 1) {
    std::vector<ExposedBit>& before = parts.emplace_back();
    for (std::size_t i = 0; i < end; ++i)
      add_character(before, link, sent.messages[n - 2].byte_start[i], link.bytes[i],
                    i + last_characters < end ? early_share : 1);
  }
  std::vector<ExposedBit>& counted = parts.emplace_back();
  for (std::size_t i = 0; i < end; ++i)
    add_character(counted, link, sent.messages.back().byte_start[i], link.bytes[i], 1);
  return parts;
}

}  // namespace sim
