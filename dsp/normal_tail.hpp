#pragma once
// The upper tail of the standard normal law, however far out: probabilities are logarithms, so they
// do not underflow.
namespace dsp {

/// What X ~ N(0, 1) is beyond a bound.
struct NormalTail {
  double log_probability;  // ln P(X >= bound)
  double hazard;           // density at the bound over P(X >= bound): the mean of X beyond it
  double mean_excess;  // mean of X - bound beyond the bound: hazard - bound, without cancellation
};

/// Relative errors below 1e-11; all are finite for |bound| < 1e150. Far out by the continued
/// fraction of Laplace (Abramowitz & Stegun 26.2.14).
NormalTail normal_tail(double bound);

/// normal_tail(bound).log_probability alone, in less time.
double log_upper_tail(double bound);

/// The normal beyond `bound` that is exceeded with probability `level`, in (0, 1]:
/// P(X >= result) = level * P(X >= bound). Error below 1e-12 for bounds up to 1000; never below the
/// bound.
double truncated_normal_quantile(double bound, double level);

}  // namespace dsp
