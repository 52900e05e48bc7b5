// Probabilities from weighted draws against closed forms and plain counting; the tilt against the
// equations of its saddle point, solved another way.
#include "dsp/truncated_orthant.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "dsp/normal_tail.hpp"
#include "dsp/philox.hpp"

namespace {

using dsp::TruncatedOrthant;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A decaying oscillation, with `jitter` on the diagonal.
MatrixXd cholesky_of_series(Index n, double decay, double turn, double jitter = 0) {
  MatrixXd k = MatrixXd::Identity(n, n) * jitter;
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) {
      const auto lag = static_cast<double>(std::abs(i - j));
      k(i, j) += std::exp(-decay * lag) * std::cos(turn * lag);
    }
  return k.llt().matrixL();
}

MatrixXd cholesky_of_equal(Index n, double rho) {
  const MatrixXd k = MatrixXd::Constant(n, n, rho) + (1 - rho) * MatrixXd::Identity(n, n);
  return k.llt().matrixL();
}

struct Estimate {
  double probability = 0;
  double variation = 0;  // deviation of one weight over their mean
  bool all_inside = true;
};

Estimate estimate(const MatrixXd& cholesky, const VectorXd& lower, const VectorXd& shift,
                  std::uint32_t draws = 20000) {
  const TruncatedOrthant proposal(cholesky, lower, shift);
  std::vector<double> uniforms(static_cast<std::size_t>(lower.size()));
  Estimate e;
  double sum = 0, squares = 0;
  for (std::uint32_t i = 0; i < draws; ++i) {
    const dsp::RandomAddress address{.seed = 17, .trial = i};
    for (std::uint32_t k = 0; k < uniforms.size(); ++k) uniforms[k] = 1 - address.uniform(k);
    const VectorXd y = proposal.draw(uniforms);
    const double weight = std::exp(-proposal.log_ratio(y));
    e.all_inside = e.all_inside && (y.array() >= lower.array()).all();
    sum += weight;
    squares += weight * weight;
  }
  e.probability = sum / draws;
  e.variation = std::sqrt(std::max(0.0, squares / draws / e.probability / e.probability - 1));
  return e;
}

/// Four deviations of the mean of 20000 weights, and rounding.
double tolerance(const Estimate& e) { return e.probability * (4 * e.variation / 141 + 1e-9); }

/// How often white noise through `cholesky` is beyond `lower`.
double counted(const MatrixXd& cholesky, const VectorXd& lower, std::uint32_t draws) {
  int inside = 0;
  VectorXd eta(lower.size());
  for (std::uint32_t i = 0; i < draws; ++i) {
    const dsp::RandomAddress address{.seed = 18, .trial = i};
    for (Index k = 0; k < eta.size(); ++k) {
      const double radius =
          std::sqrt(-2 * std::log(1 - address.uniform(2 * static_cast<unsigned>(k))));
      eta[k] = radius *
               std::cos(2 * std::numbers::pi * address.uniform(2 * static_cast<unsigned>(k) + 1));
    }
    inside += ((cholesky * eta).array() >= lower.array()).all();
  }
  return static_cast<double>(inside) / draws;
}

/// The equations of the saddle point, iterated slowly.
dsp::OrthantTilt slow_tilt(const MatrixXd& cholesky, const VectorXd& lower) {
  const Index n = lower.size();
  const MatrixXd a = cholesky.diagonal().cwiseInverse().asDiagonal() * cholesky;
  VectorXd shift = VectorXd::Zero(n), x(n), hazard(n);
  double psi = 0;
  for (int pass = 0; pass < 2400; ++pass) {
    psi = 0;
    for (Index k = 0; k < n; ++k) {
      const double tau = lower[k] / cholesky(k, k) - a.row(k).head(k).dot(x.head(k));
      hazard[k] = dsp::normal_tail(tau - shift[k]).hazard;
      x[k] = shift[k] + hazard[k];
      psi += shift[k] * (shift[k] / 2 - x[k]) + dsp::log_upper_tail(tau - shift[k]);
    }
    for (Index m = 0; m + 1 < n; ++m)
      shift[m] += 0.1 * (a.col(m).tail(n - 1 - m).dot(hazard.tail(n - 1 - m)) - shift[m]);
  }
  return {shift, psi};
}

TEST(MinimaxTilt, OfOneIsTheTail) {
  for (double lower = -5; lower <= 30; lower += 2.5) {
    const MatrixXd deviation = MatrixXd::Constant(1, 1, 2);
    const VectorXd bound = VectorXd::Constant(1, 2 * lower);
    const auto tilt = dsp::minimax_tilt(deviation, bound);
    const double exact = dsp::log_upper_tail(lower);
    EXPECT_NEAR(tilt.log_probability, exact, 1e-10);
    EXPECT_NEAR(tilt.shift[0], 0, 1e-10);
    const TruncatedOrthant proposal(deviation, bound, tilt.shift);
    for (const double u : {1e-12, 0.1, 0.9, 1.0})
      EXPECT_NEAR(proposal.log_ratio(proposal.draw(std::vector{u})), -exact, 1e-10);
  }
}

TEST(MinimaxTilt, IsTheSaddlePoint) {
  const MatrixXd cholesky = cholesky_of_series(9, 0.25, 0.3);
  VectorXd lower(9);
  lower << 3, -8, 2, 4, 0.5, -1, 5, 1, 3;
  for (const VectorXd& bounds : {lower, VectorXd(lower.reverse()), VectorXd(VectorXd::Zero(9))}) {
    const auto tilt = dsp::minimax_tilt(cholesky, bounds), slow = slow_tilt(cholesky, bounds);
    EXPECT_LT((tilt.shift - slow.shift).cwiseAbs().maxCoeff(), 1e-5);
    EXPECT_NEAR(tilt.log_probability, slow.log_probability, 1e-9);
  }
}

TEST(TruncatedOrthant, TwoAboveTheirMeans) {
  for (const double rho : {-0.95, -0.5, 0.0, 0.3, 0.9}) {
    const MatrixXd cholesky = cholesky_of_equal(2, rho);
    const auto tilt = dsp::minimax_tilt(cholesky, VectorXd::Zero(2));
    const auto e = estimate(cholesky, VectorXd::Zero(2), tilt.shift);
    EXPECT_NEAR(e.probability, 0.25 + std::asin(rho) / (2 * std::numbers::pi), tolerance(e)) << rho;
    EXPECT_GE(tilt.log_probability, std::log(e.probability - tolerance(e))) << rho;
    EXPECT_TRUE(e.all_inside);
  }
}

TEST(TruncatedOrthant, EquallyCorrelatedAboveTheirMeans) {
  for (const Index n : {3, 9, 12}) {
    const MatrixXd cholesky = cholesky_of_equal(n, 0.5);
    const auto tilt = dsp::minimax_tilt(cholesky, VectorXd::Zero(n));
    const auto e = estimate(cholesky, VectorXd::Zero(n), tilt.shift);
    EXPECT_NEAR(e.probability, 1.0 / (static_cast<double>(n) + 1), tolerance(e)) << n;
    EXPECT_LT(e.variation, 0.6) << n;
  }
}

TEST(TruncatedOrthant, AgreesWithCounting) {
  const MatrixXd cholesky = cholesky_of_series(9, 0.1, 0.1);
  const VectorXd lower = VectorXd::LinSpaced(9, 0.5, 1.5);
  const auto e = estimate(cholesky, lower, dsp::minimax_tilt(cholesky, lower).shift);
  const std::uint32_t draws = 200000;
  const double plain = counted(cholesky, lower, draws);
  EXPECT_GT(plain, 0.005);
  EXPECT_LT(plain, 0.05);
  EXPECT_NEAR(e.probability, plain, tolerance(e) + 4 * std::sqrt(plain / draws));
}

TEST(TruncatedOrthant, AnyShiftIsExact) {
  const MatrixXd cholesky = cholesky_of_series(9, 0.2, 0.2);
  const VectorXd lower = VectorXd::Constant(9, 1.0);
  const VectorXd best = dsp::minimax_tilt(cholesky, lower).shift;
  const auto e = estimate(cholesky, lower, best);
  const auto other = estimate(cholesky, lower, best + VectorXd::LinSpaced(9, -0.3, 0.3));
  EXPECT_GT(other.variation, e.variation);
  EXPECT_NEAR(other.probability, e.probability, tolerance(e) + tolerance(other));
}

TEST(TruncatedOrthant, RareEventsVaryLittle) {
  for (const double turn : {0.05, 0.15, 0.3})
    for (const double decay : {0.1, 0.3}) {
      const MatrixXd cholesky = cholesky_of_series(9, decay, turn);
      const VectorXd lower = VectorXd::LinSpaced(9, 3, 5);
      const auto tilt = dsp::minimax_tilt(cholesky, lower);
      const auto e = estimate(cholesky, lower, tilt.shift);
      EXPECT_LT(e.probability, 1e-7);
      EXPECT_LT(e.variation, 1) << decay << ' ' << turn;
      EXPECT_TRUE(e.all_inside);
      EXPECT_NEAR(tilt.log_probability, std::log(e.probability), 1.5);
      EXPECT_GE(tilt.log_probability, std::log(e.probability - tolerance(e)));
    }
}

// Where whole steps of Newton's overshoot.
TEST(TruncatedOrthant, NearlySingularVariesBearably) {
  for (const double jitter : {1e-4, 1e-6, 1e-8})
    for (const double level : {0.5, 3.0, 6.0}) {
      const MatrixXd cholesky = cholesky_of_series(9, 0, 0.2, jitter);
      const VectorXd lower = VectorXd::Constant(9, level);
      const auto tilt = dsp::minimax_tilt(cholesky, lower);
      const auto e = estimate(cholesky, lower, tilt.shift, 2000);
      EXPECT_LT(e.variation, 4) << jitter << ' ' << level;
      EXPECT_NEAR(tilt.log_probability, std::log(e.probability), 4) << jitter << ' ' << level;
      const double least = std::max(e.probability - tolerance(e), 0.0);
      EXPECT_GE(tilt.log_probability, std::log(least)) << jitter << ' ' << level;
    }
}

TEST(TruncatedOrthant, BelowABoundThereIsNothing) {
  const TruncatedOrthant proposal(cholesky_of_equal(2, 0.5), VectorXd::Zero(2), VectorXd::Zero(2));
  EXPECT_EQ(proposal.log_ratio(VectorXd::Unit(2, 0) - VectorXd::Constant(2, 1e-9)), -INFINITY);
  EXPECT_TRUE(std::isfinite(proposal.log_ratio(VectorXd::Unit(2, 0))));
}

void expect_finite(const MatrixXd& cholesky, const VectorXd& lower) {
  const auto tilt = dsp::minimax_tilt(cholesky, lower);
  ASSERT_TRUE(tilt.shift.allFinite() && std::isfinite(tilt.log_probability)) << lower.transpose();
  const TruncatedOrthant proposal(cholesky, lower, tilt.shift);
  for (const double u : {1e-16, 0.5, 1.0}) {
    const VectorXd y = proposal.draw(std::vector(static_cast<std::size_t>(lower.size()), u));
    EXPECT_TRUE(y.allFinite() && (y.array() >= lower.array()).all()) << lower.transpose();
    EXPECT_TRUE(std::isfinite(proposal.log_ratio(y))) << lower.transpose();
  }
}

TEST(TruncatedOrthant, IsFiniteAtTheExtremes) {
  const MatrixXd common = cholesky_of_series(12, 0.1, 0.05);
  const MatrixXd nearly_singular = cholesky_of_series(12, 0, 0.2, 1e-8);
  ASSERT_LT(nearly_singular.diagonal().minCoeff(), 2e-4);
  const VectorXd signs =
      VectorXd::LinSpaced(12, 0, 11).unaryExpr([](double k) { return std::fmod(k, 2.0); });
  for (const MatrixXd& cholesky : {common, nearly_singular})
    for (const double level : {-60.0, -8.0, 0.0, 3.0, 15.0, 40.0}) {
      expect_finite(cholesky, VectorXd::Constant(12, level));
      expect_finite(cholesky, VectorXd::LinSpaced(12, -8, level));
      expect_finite(cholesky, VectorXd::LinSpaced(12, level, -8));
      expect_finite(cholesky, level * signs);
    }
}

}  // namespace
