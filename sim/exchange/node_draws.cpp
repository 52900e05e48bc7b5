#include "sim/exchange/node_draws.hpp"

#include "sim/trial/trial.hpp"

namespace sim {

dsp::RandomAddress draws_of(const Exchange& exchange, std::uint32_t run, std::size_t node,
                            NodeDraws what) {
  const auto which = static_cast<std::uint32_t>(node * 8) + static_cast<std::uint32_t>(what);
  return {.seed = exchange.seed,
          .point = exchange.point,
          .trial = run,
          .purpose = static_cast<std::uint32_t>(Purpose::shared_node) + (which << 8U)};
}

}  // namespace sim
