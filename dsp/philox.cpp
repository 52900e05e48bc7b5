#include "dsp/philox.hpp"

namespace dsp {
namespace {

// Multipliers and Weyl constants of the paper's table 2 (and of its Random123 library).
constexpr std::uint32_t multiplier[2] = {0xD2511F53u, 0xCD9E8D57u};
constexpr std::uint32_t weyl[2] = {0x9E3779B9u, 0xBB67AE85u};

PhiloxBlock round(PhiloxBlock c, PhiloxKey k) {
  const std::uint64_t p0 = std::uint64_t{multiplier[0]} * c[0];
  const std::uint64_t p1 = std::uint64_t{multiplier[1]} * c[2];
  return {static_cast<std::uint32_t>(p1 >> 32) ^ c[1] ^ k[0], static_cast<std::uint32_t>(p1),
          static_cast<std::uint32_t>(p0 >> 32) ^ c[3] ^ k[1], static_cast<std::uint32_t>(p0)};
}

}  // namespace

PhiloxBlock philox4x32(PhiloxBlock counter, PhiloxKey key) {
  for (int i = 0; i < 10; ++i) {
    counter = round(counter, key);
    key[0] += weyl[0];
    key[1] += weyl[1];
  }
  return counter;
}

PhiloxBlock RandomAddress::block(std::uint32_t index) const {
  return philox4x32({index, trial, point, purpose},
                    {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)});
}

double RandomAddress::uniform(std::uint32_t index) const {
  const PhiloxBlock b = block(index);
  const std::uint64_t bits = (std::uint64_t{b[0]} << 32 | b[1]) >> 11;
  return static_cast<double>(bits) * 0x1p-53;
}

}  // namespace dsp
