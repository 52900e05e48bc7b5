#pragma once
// The random numbers of one node of an exchange, each thing's of its own.
#include <cstddef>
#include <cstdint>

#include "dsp/philox.hpp"
#include "sim/shared_link/shared_link.hpp"

namespace sim {

/// Draws of one node for one thing; a node has eight.
enum class NodeDraws : std::uint32_t { pauses, changes, queries, noise, phases, uart, lights };

dsp::RandomAddress draws_of(const SharedLinkSetup& setup, std::uint32_t run, std::size_t node,
                            NodeDraws what);

}  // namespace sim
