#include "sim/counting/stopped_loss.hpp"

#include <algorithm>
#include <boost/math/special_functions/beta.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <vector>

namespace sim {
namespace {

using QuickBeta = boost::math::policies::policy<boost::math::policies::promote_double<false>>;

constexpr double frames_of_group = 8;
/// Of frames counted, groups are taken together up to this part: the boundary is 3.3 deviations
/// away and moves by less than a hundredth of one.
constexpr double part_between_looks = 1.0 / 1024;
/// From so many counts on that have not stopped, neighbours are taken together.
constexpr std::size_t most_counts = 256;
/// Probabilities below it are left out.
constexpr double next_to_none = 1e-15;

/// An end of counting, and how probable it is at a reference.
struct LossEnd {
  double frames, lost, probability;
};
using LossEnds = std::vector<LossEnd>;

/// How probable ends are at the loss ratio `p`: all ways to an end are as much likelier than at the
/// reference.
double probability_at(double p, double reference, const LossEnds& ends) {
  const double of_lost = std::log(p / reference);
  const double of_others = std::log1p(-p) - std::log1p(-reference);
  double sum = 0;
  for (const LossEnd& end : ends)
    sum += end.probability * std::exp(end.lost * of_lost + (end.frames - end.lost) * of_others);
  return sum;
}

/// Of 0, 1, ... of so many, as far as they are anything.
std::vector<double> binomial_probabilities(int trials, double p) {
  std::vector<double> all{std::pow(1 - p, trials)};
  for (int k = 1; k <= trials && (k < trials * p || all.back() > next_to_none); ++k)
    all.push_back(all.back() * (trials - k + 1) / k * p / (1 - p));
  return all;
}

/// On which side of the rule's target a count is told to be, as side_of() says.
class ToldSides {
 public:
  explicit ToldSides(const StopRule& rule) : rule_(rule) {}

  bool below(double lost, double frames) const {
    const double target = rule_.target_flr;
    return lost < target * frames &&
           boost::math::ibetac(lost + 1, frames - lost, target, QuickBeta()) < tail;
  }
  bool above(double lost, double frames) const {
    const double target = rule_.target_flr;
    if (rule_.max_frame_errors > 0 && lost >= static_cast<double>(rule_.max_frame_errors))
      return true;
    return lost > target * frames &&
           boost::math::ibeta(lost, frames - lost + 1, target, QuickBeta()) < tail;
  }

 private:
  static constexpr double tail = (1 - sure_level) / 2;
  const StopRule& rule_;
};

/// The counts that a point may have that has not stopped, as a random walk. Where they are many,
/// their spacing and its steps grow as those of the Brownian motion that the walk then is: the
/// spacing by two, the frames by four.
class LossWalk {
 public:
  explicit LossWalk(double reference) : reference_(reference) {}

  double frames() const { return frames_; }
  double spacing() const { return spacing_; }

  /// Frames to the next look.
  double step() const {
    const double groups = std::floor(frames_ * part_between_looks / frames_of_group);
    return frames_of_group * std::max(spacing_ * spacing_, groups);
  }

  void go(double frames) {
    const auto trials = static_cast<int>(std::lround(frames / (spacing_ * spacing_)));
    const std::vector<double> more = binomial_probabilities(trials, reference_);
    std::vector<double> next(probabilities_.size() + more.size() - 1);
    for (std::size_t i = 0; i < probabilities_.size(); ++i)
      for (std::size_t j = 0; j < more.size(); ++j) next[i + j] += probabilities_[i] * more[j];
    probabilities_ = std::move(next);
    frames_ += frames;
    first_ += reference_ * (frames - spacing_ * trials);
  }

  /// Takes off what stops.
  void look(const ToldSides& sides, LossEnds& below, LossEnds& above) {
    std::ptrdiff_t first = 0, last = std::ssize(probabilities_);
    for (; first < last && sides.below(at(first).lost, frames_); ++first) keep(at(first), below);
    for (; first < last && sides.above(at(last - 1).lost, frames_); --last)
      keep(at(last - 1), above);
    probabilities_ = {probabilities_.begin() + first, probabilities_.begin() + last};
    first_ += spacing_ * static_cast<double>(first);
    if (probabilities_.size() > most_counts) coarsen();
  }

  LossEnds all() const {
    LossEnds ends;
    for (std::ptrdiff_t i = 0; i < std::ssize(probabilities_); ++i) keep(at(i), ends);
    return ends;
  }

 private:
  LossEnd at(std::ptrdiff_t i) const {
    return {frames_, first_ + spacing_ * static_cast<double>(i),
            probabilities_[static_cast<std::size_t>(i)]};
  }

  static void keep(const LossEnd& end, LossEnds& ends) {
    if (end.probability > next_to_none) ends.push_back(end);
  }

  void coarsen() {
    if (probabilities_.size() % 2 != 0) probabilities_.push_back(0);
    std::vector<double> pairs;
    for (std::size_t i = 0; i < probabilities_.size(); i += 2)
      pairs.push_back(probabilities_[i] + probabilities_[i + 1]);
    probabilities_ = std::move(pairs);
    first_ += spacing_ / 2;
    spacing_ *= 2;
  }

  double reference_;
  double frames_ = 0, first_ = 0, spacing_ = 1;
  std::vector<double> probabilities_{1};
};

/// All ends of counting against one that was seen.
class OrderedEnds {
 public:
  OrderedEnds(const StopRule& rule, double frames, double lost)
      : reference_((lost + 0.5) / (frames + 1)),
        deviation_(1 / std::sqrt(frames * reference_ * (1 - reference_))) {
    const ToldSides sides(rule);
    LossWalk walk(reference_);
    while (walk.frames() + walk.step() < frames) {
      walk.go(walk.step());
      walk.look(sides, less_, more_);
    }
    walk.go(frames - walk.frames());
    for (const LossEnd& end : walk.all()) add_last(end, lost, walk.spacing());
  }

  /// The loss ratio at which this is the probability of more, with a share of the same.
  double ratio_at(double probability, double share_of_same) const {
    const double about = std::log(reference_ / (1 - reference_));
    const auto ratio_of = [](double log_odds) { return 1 / (1 + std::exp(-log_odds)); };
    const auto excess = [&](double log_odds) {
      return more_at(ratio_of(log_odds), share_of_same) - probability;
    };
    double low = about, high = about;
    while (excess(low) > 0) low -= 2 * deviation_;
    while (excess(high) < 0) high += 2 * deviation_;
    if (low == high) return reference_;
    std::uintmax_t steps = 100;
    const boost::math::tools::eps_tolerance<double> near(30);
    return ratio_of(boost::math::tools::toms748_solve(excess, low, high, near, steps).first);
  }

 private:
  double more_at(double p, double share_of_same) const {
    const double less = probability_at(p, reference_, less_);
    const double same = probability_at(p, reference_, same_);
    const double more = probability_at(p, reference_, more_);
    return (more + share_of_same * same) / (less + same + more);
  }

  /// A count stands for all within half a spacing of it.
  void add_last(const LossEnd& end, double lost, double spacing) {
    const auto share_beyond = [&](double edge) {
      return std::clamp((end.lost - edge) / spacing + 0.5, 0.0, 1.0);
    };
    const double more = share_beyond(lost + 0.5), not_less = share_beyond(lost - 0.5);
    const auto add_share = [&](double share, LossEnds& ends) {
      if (share > 0) ends.push_back({end.frames, end.lost, share * end.probability});
    };
    add_share(more, more_);
    add_share(not_less - more, same_);
    add_share(1 - not_less, less_);
  }

  double reference_, deviation_;  // of the logarithm of the odds
  LossEnds less_, same_, more_;
};

}  // namespace

Estimate stopped_loss(const StopRule& rule, std::uint64_t frames, std::uint64_t lost,
                      double level) {
  assert(rule.target_flr > 0 && lost <= frames && frames > 0);
  const double tail = (1 - level) / 2;
  const OrderedEnds ends(rule, static_cast<double>(frames), static_cast<double>(lost));
  Estimate e{0, 0, 1};
  if (lost > 0) e.low = ends.ratio_at(tail, 1);
  if (lost < frames) e.high = ends.ratio_at(1 - tail, 0);
  if (lost == frames) e.value = 1;
  if (lost > 0 && lost < frames) e.value = ends.ratio_at(0.5, 0.5);
  return e;
}

}  // namespace sim
