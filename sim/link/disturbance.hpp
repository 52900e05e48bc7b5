#pragma once
// Other lights of a point, as the channel wants them: once a point their waves, once a trial when
// they shine.
#include "channel/disturbance.hpp"
#include "dsp/philox.hpp"
#include "dsp/units.hpp"
#include "sim/scenario/scenario.hpp"

namespace sim {

/// All steady light: the scenario's ambient, lux included, and the means of its disturbances.
dsp::WattsPerSquareMetre ambient_of(const Scenario& s);

/// The mean irradiance of a disturbance over a long time.
dsp::WattsPerSquareMetre mean_of(const DisturbanceSettings& d);

channel::Disturbance design_disturbance(const DisturbanceSettings& d, dsp::Hertz sample_rate);

/// One trial of it, from time 0 to `end`: it began long before, at a random time.
channel::DisturbanceInput draw_disturbance(const DisturbanceSettings& d,
                                           const dsp::RandomAddress& draws, dsp::Seconds end);

/// Whether it is a carrier that is keyed on and off, not a lamp.
bool is_keyed(const DisturbanceSettings& d);

/// Whether it sends the characters of a UART, a COSYS device's or a SharedLink node's.
bool sends_characters(const DisturbanceSettings& d);

/// The longest that a frame of a remote control can last; means nothing of other kinds.
dsp::Seconds longest_frame(const DisturbanceSettings& d);

}  // namespace sim
