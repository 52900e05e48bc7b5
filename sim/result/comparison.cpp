#include "sim/result/comparison.hpp"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <set>
#include <utility>

#include "sim/counting/holm.hpp"
#include "sim/counting/statistics.hpp"

namespace sim {
namespace {

double real(std::uint64_t n) { return static_cast<double>(n); }

/// Logarithm of n over k.
double log_choose(double n, double k) {
  return std::lgamma(n + 1) - std::lgamma(k + 1) - std::lgamma(n - k + 1);
}

/// Two-sided test of two proportions with a common variance.
double normal_approximation(double lost_a, double n_a, double lost_b, double n_b) {
  const double loss = (lost_a + lost_b) / (n_a + n_b);
  const double deviation = std::sqrt(loss * (1 - loss) * (1 / n_a + 1 / n_b));
  if (deviation == 0) return 1;
  const double z = std::abs(lost_a / n_a - lost_b / n_b) / deviation;
  return 2 * cdf(complement(boost::math::normal(), z));
}

/// Of a count, two-sided, that its loss is a weighted one: of the end of that one's 99 % interval
/// that is nearest, so it is rather too large.
double p_value_of_count(const Tally& counted, const Tally& weighted) {
  const Estimate loss = frame_loss_ratio(weighted, 0.99);
  const double lost = real(counted.n_frames_lost), frames = real(counted.n_frames);
  const double nearest = std::clamp(lost / frames, loss.low, loss.high);
  const boost::math::binomial all(frames, nearest);
  const double tail = lost < nearest * frames ? cdf(all, lost) : cdf(complement(all, lost - 1));
  return lost == nearest * frames ? 1 : std::min(1.0, 2 * tail);
}

/// Two-sided, that two weighted losses are one: by the logarithm of their ratio, in Student's t of
/// the one of fewer groups.
double p_value_of_weighted(const Tally& a, const Tally& b) {
  const WeightedSum &x = a.weighted.frames_lost, &y = b.weighted.frames_lost;
  constexpr double rounding = 1e-9;
  const double deviation = std::hypot(x.coefficient_of_variation(a.weighted.n_groups),
                                      y.coefficient_of_variation(b.weighted.n_groups), rounding);
  const double ratio = x.sum / real(a.n_frames) / (y.sum / real(b.n_frames));
  const boost::math::students_t t(std::min(a.weighted.n_groups, b.weighted.n_groups) - 1);
  return 2 * cdf(complement(t, std::abs(std::log(ratio)) / deviation));
}

double p_value_of_loss(const Tally& a, const Tally& b) {
  if (a.is_weighted() && b.is_weighted()) return p_value_of_weighted(a, b);
  if (a.is_weighted()) return p_value_of_count(b, a);
  if (b.is_weighted()) return p_value_of_count(a, b);
  return fisher_exact(a.n_frames_lost, a.n_frames, b.n_frames_lost, b.n_frames);
}

/// Two-sided, that two bit error ratios are one: of the widest interval of their difference that
/// has no 0 in it, made of the intervals of both (Zou & Donner, Statist. Med. 27 (2008) 1693-1702).
double p_value_of_bits(const Tally& a, const Tally& b) {
  const auto apart = [&](double p) {
    Estimate x = bit_error_ratio(a, 1 - p), y = bit_error_ratio(b, 1 - p);
    if (x.value > y.value) std::swap(x, y);
    return y.value - x.value > std::hypot(y.value - y.low, x.high - x.value);
  };
  double together = 1e-12, p = 0.5;
  if (!apart(p)) return 1;
  if (apart(together)) return together;
  while (p > 1.01 * together) {
    const double middle = std::sqrt(p * together);
    (apart(middle) ? p : together) = middle;
  }
  return p;
}

using RatioOf = Estimate (*)(const Tally&, double);

/// Weights may be such that there is no estimate, and there may be no bits.
bool both_have(RatioOf ratio_of, const Tally& a, const Tally& b) {
  return !std::isnan(ratio_of(a, 0.99).value) && !std::isnan(ratio_of(b, 0.99).value);
}

}  // namespace

double fisher_exact(std::uint64_t lost_a, std::uint64_t frames_a, std::uint64_t lost_b,
                    std::uint64_t frames_b) {
  constexpr double many = 1e6;
  const double n_a = real(frames_a), n_b = real(frames_b), lost = real(lost_a) + real(lost_b);
  if (std::max(n_a, n_b) > many) return normal_approximation(real(lost_a), n_a, real(lost_b), n_b);
  const double all = log_choose(n_a + n_b, lost);
  const auto log_probability = [&](double a) {
    return log_choose(n_a, a) + log_choose(n_b, lost - a) - all;
  };
  constexpr double rounding = 1e-7;
  const double limit = log_probability(real(lost_a)) + rounding;
  double sum = 0;
  for (double a = std::max(0.0, lost - n_b); a <= std::min(n_a, lost); ++a)
    if (const double p = log_probability(a); p <= limit) sum += std::exp(p);
  return std::min(sum, 1.0);
}

std::size_t ResultComparison::different() const {
  std::set<std::size_t> points;
  for (const RatioTest& test : tests)
    if (test.different) points.insert(test.point);
  return points.size();
}

ResultComparison compare(const LinkResult& a, const LinkResult& b, double alpha) {
  ResultComparison comparison{.equal = result_digest(a) == result_digest(b)};
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    const Tally &one = a.points[i].tally, &other = b.points[i].tally;
    if (one.n_frames == 0 || other.n_frames == 0) continue;
    const bool losses = both_have(frame_loss_ratio, one, other);
    const bool bits = both_have(bit_error_ratio, one, other);
    if (losses)
      comparison.tests.push_back({i, ComparedRatio::flr, p_value_of_loss(one, other), false});
    if (bits)
      comparison.tests.push_back({i, ComparedRatio::ber, p_value_of_bits(one, other), false});
    (losses || bits ? comparison.compared : comparison.unknown) += 1;
  }
  std::vector<double> p_values;
  for (const RatioTest& test : comparison.tests) p_values.push_back(test.p_value);
  const std::vector<bool> rejected = rejected_by_holm(p_values, alpha);
  for (std::size_t i = 0; i < rejected.size(); ++i) comparison.tests[i].different = rejected[i];
  return comparison;
}

bool same_axes(const std::vector<Axis>& a, const std::vector<Axis>& b) {
  return std::ranges::equal(a, b, [](const Axis& x, const Axis& y) {
    return x.key == y.key && x.values == y.values && x.labels == y.labels;
  });
}

}  // namespace sim
