#pragma once
// The random numbers of one node of an exchange, each thing's of its own.
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "dsp/philox.hpp"
#include "dsp/units.hpp"
#include "sim/exchange/exchange.hpp"

namespace sim {

/// Draws of one node for one thing; a node has eight.
enum class NodeDraws : std::uint32_t { pauses, changes, queries, noise, phases, uart, lights };

dsp::RandomAddress draws_of(const Exchange& exchange, std::uint32_t run, std::size_t node,
                            NodeDraws what);

/// Uniform and exponential numbers, one after the other.
class NodeNumbers {
 public:
  explicit NodeNumbers(const dsp::RandomAddress& address) : address_(address) {}
  double uniform() { return address_.uniform(next_++); }
  dsp::Seconds exponential(double mean_s) { return dsp::Seconds(-std::log1p(-uniform()) * mean_s); }

 private:
  dsp::RandomAddress address_;
  std::uint32_t next_ = 0;
};

}  // namespace sim
