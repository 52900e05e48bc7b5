#include "dsp/truncated_orthant.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>
#include <utility>

#include "dsp/normal_tail.hpp"

namespace dsp {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Botev's saddle point, max over x of the min over shift of
//   psi = sum of shift_k^2 / 2 - x_k shift_k + ln Q(s_k), s_k = tau_k(x) - shift_k,
// by its dual, which is convex and has no constraints. With A = L / diag L, b = lower / diag L, the
// hazard h and the mean excess m of s, psi is stationary where
//   x = A' h(s), shift = x - h(s), A x - b - m(s) = 0,
// and the last, times dh/ds, is the gradient over s of
//   bound(s) = |x|^2 / 2 - |h|^2 / 2 + (s - b)' h + sum of ln Q(s_k),
// which is convex in h and nowhere below psi at the saddle point, hence nowhere below ln P.
struct DualPoint {
  VectorXd s, hazard, excess, x;
  double bound;
};

struct Step {
  VectorXd direction;  // of s
  double decrement;    // Newton's: minus the slope of the bound along the direction
};

class Dual {
 public:
  Dual(const MatrixXd& cholesky, const VectorXd& lower)
      : a_(cholesky.diagonal().cwiseInverse().asDiagonal() *
           cholesky.triangularView<Eigen::Lower>().toDenseMatrix()),
        b_(lower.cwiseQuotient(cholesky.diagonal())),
        gram_(a_ * a_.transpose()) {}

  DualPoint at(VectorXd s) const {
    const Index n = s.size();
    DualPoint p{std::move(s), VectorXd(n), VectorXd(n), {}, 0};
    for (Index k = 0; k < n; ++k) {
      const NormalTail tail = normal_tail(p.s[k]);
      p.hazard[k] = tail.hazard;
      p.excess[k] = tail.mean_excess;
      p.bound += tail.log_probability;
    }
    p.x = a_.transpose() * p.hazard;
    p.bound += (p.x.squaredNorm() - p.hazard.squaredNorm()) / 2 + (p.s - b_).dot(p.hazard);
    return p;
  }

  /// Where all shifts are 0.
  DualPoint start() const {
    VectorXd s(b_.size()), x(b_.size());
    for (Index k = 0; k < s.size(); ++k) {
      s[k] = b_[k] - a_.row(k).head(k).dot(x.head(k));
      x[k] = normal_tail(s[k]).hazard;
    }
    return at(std::move(s));
  }

  /// Newton's step for A x - b - m(s) = 0. Its matrix is made symmetric by the roots of the slopes
  /// dh/ds = h m, which are in (0, 1), so that nothing is divided by them.
  Step newton(const DualPoint& p) const {
    const VectorXd slope = p.hazard.cwiseProduct(p.excess), root = slope.cwiseSqrt();
    const VectorXd residual = a_ * p.x - b_ - p.excess;
    MatrixXd matrix = root.asDiagonal() * gram_ * root.asDiagonal();
    matrix.diagonal() += VectorXd::Ones(slope.size()) - slope;
    const VectorXd scaled = matrix.llt().solve(root.cwiseProduct(-residual));
    const VectorXd change = root.cwiseProduct(scaled);  // of the hazards
    return {change - residual - gram_ * change, -residual.dot(change)};
  }

 private:
  MatrixXd a_;
  VectorXd b_;
  MatrixXd gram_;
};

/// After the first of ever shorter steps that lowers the bound enough (Armijo's rule); `from` if
/// none does.
DualPoint descend(const Dual& dual, const DualPoint& from, const Step& step) {
  for (double length = 1; length > 1e-6; length /= 2) {
    DualPoint to = dual.at(from.s + length * step.direction);
    if (to.bound <= from.bound - 1e-4 * length * step.decrement) return to;
  }
  return from;
}

}  // namespace

OrthantTilt minimax_tilt(const MatrixXd& cholesky, const VectorXd& lower) {
  constexpr int max_steps = 100;
  constexpr double enough = 1e-12;  // of the bound
  const Dual dual(cholesky, lower);
  DualPoint best = dual.start();
  for (int i = 0; i < max_steps; ++i) {
    const Step step = dual.newton(best);
    if (!(step.decrement > enough)) break;
    DualPoint next = descend(dual, best, step);
    if (!(next.bound < best.bound)) break;
    best = std::move(next);
  }
  return {best.x - best.hazard, best.bound};
}

TruncatedOrthant::TruncatedOrthant(MatrixXd cholesky, VectorXd lower, VectorXd shift)
    : cholesky_(std::move(cholesky)), lower_(std::move(lower)), shift_(std::move(shift)) {}

TruncatedOrthant::Conditional TruncatedOrthant::conditional(Index k, const VectorXd& eta) const {
  const double mean = cholesky_.row(k).head(k).dot(eta.head(k)), deviation = cholesky_(k, k);
  return {mean, deviation, (lower_[k] - mean) / deviation - shift_[k]};
}

VectorXd TruncatedOrthant::draw(std::span<const double> uniforms) const {
  const Index n = lower_.size();
  VectorXd eta(n), y(n);
  for (Index k = 0; k < n; ++k) {
    const auto [mean, deviation, bound] = conditional(k, eta);
    eta[k] = shift_[k] + truncated_normal_quantile(bound, uniforms[static_cast<std::size_t>(k)]);
    y[k] = std::max(lower_[k], mean + deviation * eta[k]);
  }
  return y;
}

double TruncatedOrthant::log_ratio(const VectorXd& y) const {
  if ((y.array() < lower_.array()).any()) return -std::numeric_limits<double>::infinity();
  VectorXd eta(y.size());
  double sum = 0;
  for (Index k = 0; k < y.size(); ++k) {
    const auto [mean, deviation, bound] = conditional(k, eta);
    eta[k] = (y[k] - mean) / deviation;
    sum += shift_[k] * (eta[k] - shift_[k] / 2) - log_upper_tail(bound);
  }
  return sum;
}

}  // namespace dsp
