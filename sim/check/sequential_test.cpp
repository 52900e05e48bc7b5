#include "sim/check/sequential_test.hpp"

#include <algorithm>
#include <array>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/poisson.hpp>
#include <cmath>

#include "sim/counting/statistics.hpp"

namespace sim {
namespace {

using Unpromoted = boost::math::policies::policy<boost::math::policies::promote_double<false>>;
using Binomial = boost::math::binomial_distribution<double, Unpromoted>;
using Poisson = boost::math::poisson_distribution<double, Unpromoted>;

constexpr std::uint64_t fewest_in_a_look = 64, most_looks = 8;
constexpr double share_of_last_look = 0.5;
constexpr std::uint64_t most_frames_of_a_point = 1'000'000'000;

/// Stakes of the martingale, equally weighted: small ones for decoders that fail apart, large ones
/// for those that fail together.
constexpr std::array stakes{0.02, 0.05, 0.1, 0.2, 0.4, 0.8, 0.95};

/// A bet on each frame that the candidate loses less than `worse_than` times as often.
double log_gain(const PairedLosses& losses, double worse_than, double stake) {
  return static_cast<double>(losses.both) * std::log1p(stake * (worse_than - 1)) +
         static_cast<double>(losses.candidate_only) * std::log1p(-stake) +
         static_cast<double>(losses.baseline_only) * std::log1p(stake * worse_than);
}

/// The part of 1 - power for each of three ways to pass.
double third_of_misses(const SequentialTestRule& rule) { return (1 - rule.power) / 3; }

/// Of a wider distribution not each number is looked at, as neighbours hardly differ.
constexpr double most_terms = 400;

/// The expectation of `probability(n)`, n being Poisson's.
template <class Probability>
double mean_over_discordant(double mean, const Probability& probability) {
  const Poisson discordant(mean);
  const double spread = 8 * std::sqrt(mean) + 10;
  const double step = std::max(1.0, std::floor(2 * spread / most_terms));
  double sum = 0;
  for (double n = std::floor(std::max(1.0, mean - spread)); n <= mean + spread; n += step)
    sum += step * pdf(discordant, n) * probability(n);
  return sum;
}

}  // namespace

std::vector<SequentialTestLook> sequential_test_looks(std::uint64_t frames) {
  std::vector<SequentialTestLook> looks;
  for (std::uint64_t n = frames; n >= fewest_in_a_look && looks.size() < most_looks; n /= 2)
    looks.push_back({n, 0});
  if (looks.empty()) looks.push_back({frames, 0});
  std::ranges::reverse(looks);
  const auto before = static_cast<double>(looks.size() - 1);
  for (SequentialTestLook& look : looks) look.share = (1 - share_of_last_look) / before;
  looks.back().share = looks.size() == 1 ? 1 : share_of_last_look;
  return looks;
}

bool is_negligible(std::uint64_t lost, std::uint64_t frames, const SequentialTestRule& rule) {
  const double level = 1 - 2 * third_of_misses(rule);
  return clopper_pearson(static_cast<double>(lost), static_cast<double>(frames), level).high <=
         rule.negligible;
}

std::uint64_t frames_to_be_negligible(const SequentialTestRule& rule) {
  if (rule.negligible <= 0) return 0;
  return static_cast<std::uint64_t>(
      std::ceil(std::log(third_of_misses(rule)) / std::log1p(-rule.negligible)));
}

double evidence_of_being_no_worse(const PairedLosses& losses, double worse_than) {
  double sum = 0;
  for (const double stake : stakes) sum += std::exp(log_gain(losses, worse_than, stake));
  return sum / static_cast<double>(stakes.size());
}

SequentialTest::SequentialTest(const SequentialTestRule& rule, std::uint64_t frames,
                               std::uint64_t points)
    : rule_(rule), points_(static_cast<double>(points)), looks_(sequential_test_looks(frames)) {}

std::uint64_t SequentialTest::next_look() const {
  return next_ < looks_.size() ? looks_[next_].frames : 0;
}

void SequentialTest::look(const PairedLosses& losses) {
  p_value_ = std::min(p_value_, mcnemar_p_value(losses) / looks_.at(next_++).share);
  const double miss = third_of_misses(rule_);
  const bool last = next_ == looks_.size();
  passed_ = passed_ || evidence_of_being_no_worse(losses, rule_.worse_than) >= 1 / miss ||
            (last && no_worse_p_value(losses, rule_.worse_than) <= miss) ||
            (last && is_negligible(losses.lost_by_candidate(), losses.frames, rule_));
  if (p_value_ <= rule_.alpha / points_)
    state_ = SequentialTestState::worse;
  else if (passed_)
    state_ = SequentialTestState::passed;
}

double finding_probability(const SequentialTestRule& rule, const LossRatios& flr,
                           std::uint64_t frames, std::uint64_t points) {
  const double only_candidate = flr.candidate * (1 - flr.baseline);
  const double only_baseline = flr.baseline * (1 - flr.candidate);
  const double of_candidate = only_candidate / (only_candidate + only_baseline);
  const double alpha =
      rule.alpha / static_cast<double>(points) * sequential_test_looks(frames).back().share;
  const double mean = static_cast<double>(frames) * (only_candidate + only_baseline);
  return mean_over_discordant(mean, [&](double n) {
    const auto critical =
        static_cast<double>(mcnemar_critical(static_cast<std::uint64_t>(n), alpha));
    const Binomial lost(n, of_candidate);
    return critical > n ? 0 : cdf(complement(lost, critical - 1));
  });
}

double power_of(const SequentialTestRule& rule, double flr, std::uint64_t frames,
                std::uint64_t points) {
  return finding_probability(rule, {flr, std::min(1.0, flr * rule.worse_than)}, frames, points);
}

double pass_probability(const SequentialTestRule& rule, double flr, std::uint64_t frames) {
  const double mean = static_cast<double>(frames) * 2 * flr * (1 - flr);
  return mean_over_discordant(mean, [&](double n) {
    const auto critical = static_cast<double>(
        no_worse_critical(static_cast<std::uint64_t>(n), rule.worse_than, third_of_misses(rule)));
    const Binomial lost(n, 0.5);
    return critical < 1 ? 0 : cdf(lost, critical - 1);
  });
}

std::uint64_t frames_needed(const SequentialTestRule& rule, double flr, std::uint64_t points,
                            double sureness) {
  const auto enough = [&](std::uint64_t frames) {
    return power_of(rule, flr, frames, points) >= sureness &&
           pass_probability(rule, flr, frames) >= sureness;
  };
  std::uint64_t too_few = 0, many = fewest_in_a_look;
  while (!enough(many)) {
    if (many > most_frames_of_a_point) return many;
    too_few = many;
    many *= 2;
  }
  while (many - too_few > std::max<std::uint64_t>(1, many / 100)) {
    const std::uint64_t middle = too_few + (many - too_few) / 2;
    (enough(middle) ? many : too_few) = middle;
  }
  return many;
}

}  // namespace sim
