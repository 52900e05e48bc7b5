#pragma once
// Arena: one point with everything worked out that its runs share: who sends, what light of each
// gets to the receiver along its way, and the receiver.
#include <cstdint>
#include <vector>

#include "channel/chain.hpp"
#include "dsp/units.hpp"
#include "protocol/uart_receivers.hpp"
#include "sim/arena/light_track.hpp"
#include "sim/arena/sending.hpp"
#include "sim/arena/trajectory.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/threads/parallel_runs.hpp"

namespace sim {

struct Arena {
  std::vector<Sender> senders;
  std::vector<LightTrack> light{};  // of each
  Trajectory way;
  dsp::Seconds duration{};  // frames that start within it count
  dsp::Seconds end{};       // of the simulation: those have ended
  // Light and module; other lights of the scenario come before those of the senders.
  channel::ChainDesign chain{};
  bool has_slow_agc = false;
  channel::ModuleDesign without_slow_agc{};  // the same module, but for that
  std::vector<DisturbanceSettings> disturbances{};
  double reach_mw_per_m2 = 0;  // least irradiance that the module hears, its slow AGC at rest
  dsp::Seconds delay{};        // constant part, light to pin
  // Receiver.
  dsp::Hertz receiver_baud{};
  bool has_monostable = false;  // that makes whole bits of short pulses before the UART
  const protocol::UartReceiver* uart = nullptr;
  std::uint64_t validity_flags = 0;  // of sim/link/validity, for any sender where it is in reach
  // Randomness.
  std::uint64_t seed = 0;
  std::uint32_t point = 0;  // hash of the point's canonical text
};

/// Throws bad_input for what the keys alone do not show: ways whose lists do not fit together,
/// messages too long for their source. After an interrupt it gives up soon, and what it returns is
/// worth nothing.
Arena make_arena(const Scenario& scenario, const Workers& workers = {});

/// How long the runs of a scenario are.
dsp::Seconds duration_of(const Scenario& scenario, const Trajectory& way);

}  // namespace sim
