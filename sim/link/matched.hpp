#pragma once
// What a point needs for a matched receiver (channel/ideal_receiver.hpp): its threshold, the light
// of a wanted Eb/N0, and the bit error ratio that theory gives it.
#include <optional>

#include "channel/chain.hpp"
#include "channel/decision.hpp"
#include "channel/noise.hpp"
#include "protocol/uart.hpp"

namespace sim {

/// Peak irradiance at which Eb/N0 is `ebn0_db` with everything else as in `light`; the signal's own
/// shot noise is counted where the part has it. Needs noise.
dsp::WattsPerSquareMetre signal_for_ebn0(const channel::ModuleData& module,
                                         const channel::LightSettings& light, dsp::Hertz baud,
                                         double ebn0_db);

/// Eb/N0 of a light as a ratio: half of the bits being light (average-energy convention), N0 the
/// one-sided density with the carrier on. Infinite without noise.
double ebn0_of(const channel::ModuleData& module, const channel::LightSettings& light,
               dsp::Hertz baud);

struct MatchedReceiver {
  channel::IdealDesign design;
  channel::CorrelatorOutput output;
  double ber;  // of theory, for these bytes' share of light; NaN where others' light disturbs
};

/// Nothing if the part is a module.
std::optional<MatchedReceiver> matched_receiver(const channel::ModuleData& module,
                                                const channel::LightSettings& light,
                                                const channel::ChainDesign& chain, dsp::Hertz baud,
                                                const protocol::Bytes& bytes);

/// Share of light among the line bits of these bytes: `IND 011111 OK 46\n` has 0.6235.
double lit_share(const protocol::Bytes& bytes);

}  // namespace sim
