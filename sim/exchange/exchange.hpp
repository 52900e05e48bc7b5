#pragma once
// Exchange: two SharedLink nodes that talk by light, half duplex. Each has an LED and a receiver
// module, and its module gets the light of the other and what the floor reflects of its own: it
// hears itself, and its gain control settles on that.
//
// A node takes its turn when its pause is over and nothing was heard of the other for a while; what
// both send at once collides. Time goes on in ticks, in which a node's processor looks at its UART.
#include <array>
#include <atomic>
#include <cstdint>
#include <vector>

#include "channel/chain.hpp"
#include "dsp/units.hpp"
#include "protocol/shared_link.hpp"
#include "protocol/uart.hpp"
#include "sim/age_counts.hpp"
#include "sim/exchange/settings.hpp"
#include "sim/scenario.hpp"

namespace sim {

/// Reflected light is the first of the chain's disturbances.
struct Exchange {
  ExchangeSettings settings;
  channel::ChainDesign chain;
  std::vector<DisturbanceSettings> disturbances;  // of the scenario, behind that
  dsp::Hertz baud, receiver_baud;                 // true rates
  dsp::Seconds delay;                             // constant part, light to pin
  const protocol::UartReceiver* uart = nullptr;
  double irradiance_mw_per_m2 = 0, reflected_mw_per_m2 = 0;
  // Of sim/validity; of bursts as of device.message, which has longer ones than SharedLink.
  std::uint64_t outside = 0;
  std::uint64_t seed = 0;
  std::uint32_t point = 0;
};

Exchange make_exchange(const Scenario& scenario);

/// One direction, named by its sender; of a run or more.
struct DirectionTally {
  std::uint64_t n_sent = 0, n_accepted = 0;  // messages
  std::uint64_t n_bits = 0, n_bit_errors = 0;
  std::uint64_t n_asked = 0, n_answered = 0, n_timed_out = 0;  // questions of the sender
  std::uint64_t n_own = 0;  // messages of its own that the sender heard
  std::array<std::uint64_t, protocol::shared_link_outcomes> rejected{};  // by the receiver
  AgeCounts age;  // of its variables at the receiver, since the turn that brought their value

  DirectionTally& operator+=(const DirectionTally& other);
};

struct ExchangeTally {
  std::array<DirectionTally, 2> direction;  // A to B, B to A
  std::uint64_t n_runs = 0;

  ExchangeTally& operator+=(const ExchangeTally& other);
};

/// Runs first ... first + n - 1. Worth nothing once `*stop` is true: it then gives up soon.
ExchangeTally run_exchange(const Exchange& exchange, std::uint32_t first, int n,
                           const std::atomic<bool>* stop = nullptr);

}  // namespace sim
