// Closed forms against numbers that others computed: scipy 1.10 (norm.sf, ncx2, brentq on i0e), and
// where a paper prints them.
#include "sim/link/theory.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "theory_case.hpp"

namespace sim {
namespace {

void expect_equal(double value, double golden) { EXPECT_NEAR(value / golden, 1, 2e-11) << golden; }

TEST(Theory, GaussianQ) {
  EXPECT_EQ(gaussian_q(0), 0.5);
  expect_equal(gaussian_q(1), 1.586552539314571e-1);
  expect_equal(gaussian_q(3), 1.349898031630093e-3);
  expect_equal(gaussian_q(5), 2.866515718791933e-7);
  expect_equal(gaussian_q(8), 6.220960574271740e-16);
  expect_equal(gaussian_q(-1), 8.413447460685429e-1);
}

TEST(Theory, MarcumQ) {
  expect_equal(marcum_q1(0, 1), 6.0653065971263e-1);  // exp(-1/2): a Rayleigh envelope
  expect_equal(marcum_q1(1, 1), 7.3287980379682e-1);
  expect_equal(marcum_q1(1, 2), 2.6901206003591e-1);
  expect_equal(marcum_q1(2, 1), 9.1810769636941e-1);
  expect_equal(marcum_q1(3, 4), 1.9651218938841e-1);
  expect_equal(marcum_q1(10, 12), 2.5329474297941e-2);
  expect_equal(marcum_p1(5, 3), 1.6616329567244e-2);
  expect_equal(marcum_p1(10, 5), 1.9936354810421e-7);
  EXPECT_EQ(marcum_q1(2, 0), 1);
}

// Where the series hands over to the Gaussian form.
TEST(Theory, MarcumQOfStrongSignalsGoesOnSmoothly) {
  for (const double away : {-3.0, 0.0, 2.0}) {
    const double below = marcum_p1(999.999, 999.999 + away);
    const double above = marcum_p1(1000.001, 1000.001 + away);
    EXPECT_NEAR(above / below, 1, 1e-3) << away;
  }
}

struct Golden {
  double db, average, peak, threshold, optimum, half;
};

// 14 dB ... of the same formulas, by scipy.
constexpr Golden goldens[] = {{0, 1.586552539315e-01, 2.397500610935e-01, 1.750873702323,
                               2.566358593375e-01, 3.442114816716e-01},
                              {3, 7.889587198172e-02, 1.589421890535e-01, 2.039213029370,
                               1.418177137195e-01, 2.080564733290e-01},
                              {6, 2.300713887787e-02, 7.914243125809e-02, 2.511000412857,
                               4.667581434435e-02, 7.575323713268e-02},
                              {10, 7.827011290013e-04, 1.267365933873e-02, 3.552711568096,
                               1.912809979473e-03, 3.635119219033e-03},
                              {12, 3.430262386642e-05, 2.438536908316e-03, 4.318168515358,
                               9.284027173405e-05, 1.927143445906e-04},
                              {14, 2.695148117367e-07, 1.971057582261e-04, 5.301488240210,
                               8.114507908399e-07, 1.849541177341e-06}};

TEST(Theory, OnOffKeying) {
  for (const Golden& golden : goldens) {
    const double ebn0 = ratio_of(golden.db);
    expect_equal(coherent_ook_ber(ebn0), golden.average);
    expect_equal(coherent_ook_ber_peak(ebn0), golden.peak);
    const double optimum = optimum_envelope_threshold(ebn0);
    expect_equal(optimum, golden.threshold);
    expect_equal(noncoherent_ook_ber(ebn0, {optimum}), golden.optimum);
    expect_equal(noncoherent_ook_ber(ebn0, {lit_amplitude(ebn0) / 2}), golden.half);
    expect_equal(coherent_ook_ber(ebn0, {lit_amplitude(ebn0) / 2, 0.3}), golden.average);
  }
}

// AFF3CT's published reference of OOK, whose Eb is that of a lit bit: 1.26e-2 at 10 dB.
TEST(Theory, PeakEnergyFormIsThatOfAff3ct) {
  EXPECT_NEAR(coherent_ook_ber_peak(ratio_of(10)), 1.26e-2, 1e-4);
  EXPECT_NEAR(coherent_ook_ber_peak(2 * 7.5), coherent_ook_ber(7.5), 1e-15);
}

TEST(Theory, OptimumThresholdIsAMinimum) {
  for (const double db : {-10.0, 0.0, 7.0, 14.0, 20.0}) {
    const double ebn0 = ratio_of(db), best = optimum_envelope_threshold(ebn0);
    const double least = noncoherent_ook_ber(ebn0, {best});
    EXPECT_GT(noncoherent_ook_ber(ebn0, {best * 1.02}), least) << db;
    EXPECT_GT(noncoherent_ook_ber(ebn0, {best * 0.98}), least) << db;
  }
}

// More light than dark among the bits: more misses, fewer false alarms.
TEST(Theory, ShareOfLightWeighsTheTwoKindsOfError) {
  const double t = 2.5, dark = std::exp(-t * t / 2);
  const double misses = marcum_p1(lit_amplitude(4), t);
  EXPECT_DOUBLE_EQ(noncoherent_ook_ber(4, {t, 0}), dark);
  EXPECT_DOUBLE_EQ(noncoherent_ook_ber(4, {t, 1}), misses);
  EXPECT_DOUBLE_EQ(noncoherent_ook_ber(4, {t, 0.25}), 0.25 * misses + 0.75 * dark);
}

TEST(Theory, EndsAreFinite) {
  EXPECT_NEAR(optimum_envelope_threshold(1e-12), std::sqrt(2.0), 1e-3);
  EXPECT_NEAR(noncoherent_ook_ber(0, {optimum_envelope_threshold(0)}), 0.5, 1e-12);
  for (const double db : {40.0, 60.0, 100.0}) {
    const double ebn0 = ratio_of(db), a = lit_amplitude(ebn0);
    EXPECT_NEAR(optimum_envelope_threshold(ebn0) / a, 0.5, 1e-2) << db;
    EXPECT_LT(noncoherent_ook_ber(ebn0, {optimum_envelope_threshold(ebn0)}), 1e-300) << db;
    EXPECT_LT(noncoherent_ook_ber(ebn0, {0.9 * a}), 0.5) << db;
  }
}

}  // namespace
}  // namespace sim
