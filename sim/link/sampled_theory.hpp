#pragma once
// The bit error ratio of a matched receiver that hears the samples of a waveform. The closed forms
// (sim/link/theory.hpp) have bits that are all alike; of samples they are not: a bit is no whole
// number of carrier cycles, its edges fall between samples, and at a carrier that divides the
// sample rate harmonics fall on it. A bit measures more or less of the light by its phase, and
// where it measures less there are more errors than where it measures more there are fewer.
#include "channel/chain.hpp"
#include "protocol/uart.hpp"

namespace sim {

/// Light of a square carrier from one phase to another, in cycles from 0 on: the share in a
/// sample's mean, in mW/m2, of the time in which the phase goes from one to the other.
double carrier_light(const channel::CarrierDesign& carrier, double from, double to);

/// Mean over carrier phases and over where bits begin between samples, for the bits of `bytes`, not
/// empty, with those beside them. There are no other lights, and the receiver has the sender's
/// baud. Looks at four million samples at most: not a number for bits of more than 250 000.
double sampled_ber(const channel::ChainDesign& chain, const channel::IdealDesign& receiver,
                   dsp::Hertz baud, const protocol::Bytes& bytes);

}  // namespace sim
