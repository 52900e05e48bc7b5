#pragma once
// The draws of one address in the order in which they are asked for, where how many there will be
// hangs on what was drawn before.
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "dsp/philox.hpp"
#include "dsp/units.hpp"

namespace dsp {

class RandomStream {
 public:
  explicit RandomStream(const RandomAddress& address) : address_(address) {}

  /// Uniform on [0, 1).
  double uniform() { return address_.uniform(next_++); }
  /// Uniform on 0 ... n - 1; n is at least 1 and less than 2^53.
  std::size_t index(std::size_t n) {
    return static_cast<std::size_t>(uniform() * static_cast<double>(n));
  }
  Seconds exponential(Seconds mean) { return -std::log1p(-uniform()) * mean; }
  PhiloxBlock block() { return address_.block(next_++); }

 private:
  RandomAddress address_;
  std::uint32_t next_ = 0;
};

}  // namespace dsp
