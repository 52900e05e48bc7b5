#include "sim/shared_link/node_draws.hpp"

#include "sim/trial/trial.hpp"

namespace sim {

dsp::RandomAddress draws_of(const SharedLinkSetup& setup, std::uint32_t run, std::size_t node,
                            NodeDraws what) {
  const auto which = static_cast<std::uint32_t>(node * 8) + static_cast<std::uint32_t>(what);
  return {.seed = setup.seed,
          .point = setup.point,
          .trial = run,
          .purpose = static_cast<std::uint32_t>(Purpose::shared_node) + (which << 8U)};
}

}  // namespace sim
