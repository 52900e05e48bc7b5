#include "sim/check/detectable_loss.hpp"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <limits>

#include "sim/counting/statistics.hpp"

namespace sim {
namespace {

/// The most lost frames that are negligible, plus 1; 0 if none are.
std::uint64_t count_of_negligible(const SequentialTestRule& rule, std::uint64_t frames) {
  std::uint64_t most = 0, too_many = frames + 1;
  while (most < too_many) {
    const std::uint64_t middle = most + (too_many - most) / 2;
    if (is_negligible(middle, frames, rule))
      most = middle + 1;
    else
      too_many = middle;
  }
  return most;
}

double probability_of_negligible(const SequentialTestRule& rule, const PointLosses& baseline) {
  const std::uint64_t count = count_of_negligible(rule, baseline.frames);
  if (count == 0) return 0;
  if (count > baseline.frames) return 1;
  const boost::math::binomial_distribution<> lost(static_cast<double>(baseline.frames),
                                                  baseline.flr());
  return cdf(lost, static_cast<double>(count - 1));
}

}  // namespace

double PointLosses::flr() const { return ratio(lost, frames); }

double detectable_loss(const SequentialTestRule& rule, const PointLosses& baseline,
                       double probability) {
  const auto is_found = [&](double flr) {
    return finding_probability(rule, {baseline.flr(), flr}, baseline.frames,
                               tests_of_points(baseline.points)) >= probability;
  };
  constexpr double tolerance = 0.01;
  double least = baseline.flr(), found = 1;
  if (baseline.frames == 0 || least == 1 || !is_found(found))
    return std::numeric_limits<double>::quiet_NaN();
  while (found - least > tolerance * found) {
    const double middle = least + (found - least) / 2;
    (is_found(middle) ? found : least) = middle;
  }
  return found;
}

double passes_if_equal(const SequentialTestRule& rule, const PointLosses& baseline) {
  if (baseline.frames == 0) return 0;
  if (baseline.lost == 0 || baseline.lost == baseline.frames)
    return probability_of_negligible(rule, baseline);
  return std::max(probability_of_negligible(rule, baseline),
                  pass_probability(rule, baseline.flr(), baseline.frames));
}

std::uint64_t frames_to_detect(const SequentialTestRule& rule, const PointLosses& baseline,
                               double probability) {
  constexpr std::uint64_t most = 1'000'000'000;
  if (baseline.frames == 0) return 0;
  const double flr = baseline.flr();
  if (flr * rule.worse_than <= rule.negligible || flr * rule.worse_than > 1) return 0;
  const std::uint64_t frames =
      frames_needed(rule, flr, tests_of_points(baseline.points), probability);
  return frames > most ? 0 : frames;
}

}  // namespace sim
