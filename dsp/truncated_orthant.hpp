#pragma once
// Correlated normals y ~ N(0, K) given that every y_k >= lower_k, for importance sampling of rare
// events: drawn one after the other from truncated normals (the separation of variables of Geweke,
// Hajivassiliou and Keane), each shifted so that the weights vary least. The density drawn from is
// known exactly. Shift: Z. I. Botev, "The normal law under linear restrictions: simulation and
// estimation via minimax tilting", J. R. Stat. Soc. B 79 (2017), 125-148.
//
// With K = L L', y = L eta and eta_k ~ N(shift_k, 1) beyond
//   tau_k = (lower_k - sum over m < k of L_km eta_m) / L_kk.
// In all of it L is lower triangular with a positive diagonal (what is above it is not read), and
// L, lower and shift are finite, of n >= 1 rows each.
#include <Eigen/Core>
#include <span>

namespace dsp {

/// How to draw (see TruncatedOrthant), and how probable the event is, roughly.
struct OrthantTilt {
  Eigen::VectorXd shift;
  double log_probability = 0;  // at least ln P(y >= lower)
};

/// The shift of the smallest upper bound of ln P(y >= lower), and that bound. Where Newton's method
/// gets no further (only seen where K is all but singular) the best found is returned: its
/// bound holds but for rounding, if loosely; its shift is as exact to draw with as any other.
OrthantTilt minimax_tilt(const Eigen::MatrixXd& cholesky, const Eigen::VectorXd& lower);

/// Safe to use from several threads.
class TruncatedOrthant {
 public:
  /// Any shift will do, also the tilt of a slightly other covariance: `log_ratio` is exact for it.
  TruncatedOrthant(Eigen::MatrixXd cholesky, Eigen::VectorXd lower, Eigen::VectorXd shift);

  /// The y of n uniforms in (0, 1].
  Eigen::VectorXd draw(std::span<const double> uniforms) const;

  /// ln of the density at y of what `draw` gives, over that of N(0, K); -infinity where a y_k is
  /// below its bound. The mean of exp(-log_ratio) over draws is P(y >= lower).
  double log_ratio(const Eigen::VectorXd& y) const;

 private:
  /// y_k given the eta before it: N(mean, deviation^2), and where its noise less its shift begins.
  struct Conditional {
    double mean, deviation, bound;
  };
  Conditional conditional(Eigen::Index k, const Eigen::VectorXd& eta) const;

  Eigen::MatrixXd cholesky_;
  Eigen::VectorXd lower_, shift_;
};

}  // namespace dsp
