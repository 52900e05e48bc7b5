#pragma once
// Closed forms for the bit error ratio of on-off keying in white Gaussian noise, against which the
// matched receivers are checked. Eb/N0 as a ratio, not in dB; N0 one-sided. Average-energy
// convention unless a name says peak: Eb is the mean energy of light and dark bits, one to one, so
// half of a lit bit's. Distances and thresholds in standard deviations of the correlator's output,
// a component: a lit bit is then at 2 sqrt(Eb/N0). Proakis & Salehi, "Digital Communications",
// 5th ed., 2.3 (Marcum Q), 4.2, 4.5; Ghassemlooy et al., "Optical Wireless Communications", 4.4.

namespace sim {

/// Probability that a standard normal exceeds x.
double gaussian_q(double x);
/// The x that a standard normal exceeds with probability p, 0 < p < 1.
double gaussian_q_inverse(double p);

/// Marcum Q of order 1: probability that the envelope of a signal of amplitude a >= 0 in noise of
/// unit deviation a component exceeds b >= 0; and its complement, exact where it is small.
double marcum_q1(double a, double b);
double marcum_p1(double a, double b);

/// Amplitude of a lit bit in standard deviations.
double lit_amplitude(double ebn0);

/// Coherent on-off keying at the middle threshold: Q(sqrt(Eb/N0)); Eb of a lit bit ("peak"):
/// Q(sqrt(Eb/N0 / 2)), the same curve 3.01 dB to the right.
double coherent_ook_ber(double ebn0);
double coherent_ook_ber_peak(double ebn0);

/// What a share `lit` of light among the bits makes of a threshold.
struct OokThreshold {
  double deviations;
  double lit = 0.5;
};
double coherent_ook_ber(double ebn0, const OokThreshold& threshold);
double noncoherent_ook_ber(double ebn0, const OokThreshold& threshold);

/// Threshold of the envelope at which light and dark are equally likely, in standard deviations:
/// I0(a t) = exp(a^2 / 2), a the lit amplitude.
double optimum_envelope_threshold(double ebn0);

}  // namespace sim
