#pragma once
// Spectrum: how the power of a sampled signal spreads over frequency (Welch's averaged
// periodograms), and the amplitude of one line in it. One-sided: the densities times the bin width
// add up to the mean square. Safe to call from several threads.
#include <cstddef>
#include <span>
#include <vector>

#include "dsp/units.hpp"

namespace dsp {

struct Spectrum {
  std::vector<double> frequency_hz;  // evenly spaced from 0 to half the sample rate
  std::vector<double> density;       // signal units squared per hertz
};

enum class Mean { keep, remove };  // of each segment, before its window

/// Welch's estimate from Hann-windowed segments that overlap by half. A segment longer than the
/// data is shortened to it (one periodogram, coarser bins); samples after the last whole segment
/// are not used. There must be samples, and `segment` must be at least 2 of them.
Spectrum welch(std::span<const float> samples, Hertz sample_rate, std::size_t segment,
               Mean mean = Mean::remove);

/// Amplitude of the component at `f` (0 to half the sample rate): of A cos(2 pi f t + phase) it is
/// A where the samples hold whole periods, and so it is of each line whose periods fit.
double line_amplitude(std::span<const float> samples, Hertz sample_rate, Hertz f);

/// Mean square of the signal in the bins whose centres lie in [f_low, f_high].
double band_power(const Spectrum& spectrum, Hertz f_low, Hertz f_high);

}  // namespace dsp
