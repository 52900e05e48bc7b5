#pragma once
// Exchange: two SharedLink nodes that talk by light, half duplex. Each has an LED and a receiver
// module, and its module gets the light of the other and what the floor reflects of its own: it
// hears itself, and its gain control settles on that.
//
// A node takes its turn when its pause is over and nothing was heard of the other for a while; what
// both send at once collides. Time goes on in ticks, in which a node's processor looks at its UART.
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "channel/chain.hpp"
#include "dsp/units.hpp"
#include "protocol/uart_receivers.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/shared_link/shared_link_keys.hpp"
#include "sim/shared_link/shared_link_tally.hpp"

namespace sim {

/// Which of the chain's disturbances is the reflected light.
inline constexpr std::size_t own_reflection = 0;

struct SharedLinkSetup {
  SharedLinkSettings settings;
  channel::ChainDesign chain;
  std::vector<DisturbanceSettings> disturbances;  // of the scenario, behind that
  dsp::Hertz baud, receiver_baud;                 // true rates
  dsp::Seconds delay;                             // constant part, light to pin
  const protocol::UartReceiver* uart = nullptr;
  double irradiance_mw_per_m2 = 0, reflected_mw_per_m2 = 0;
  // Of sim/link/validity; of bursts as of device.message, which has longer ones than SharedLink.
  std::uint64_t validity_flags = 0;
  std::uint64_t seed = 0;
  std::uint32_t point = 0;
};

SharedLinkSetup make_shared_link(const Scenario& scenario);

/// Runs first ... first + n - 1. Worth nothing once `*stop` is true: it then gives up soon.
SharedLinkTally run_shared_link(const SharedLinkSetup& setup, std::uint32_t first, int n,
                                const std::atomic<bool>* stop = nullptr);

}  // namespace sim
