#include "sim/fit/profile_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace sim {
namespace {

/// In standard deviations of the curvature, which are a few times too small (fitted_numbers.cpp).
constexpr std::array moves{-10., -7., -5., -3.5, -2.5, -1.5, -0.7, 0.7, 1.5, 2.5, 3.5, 5., 7., 10.};
constexpr double hopeless = 60;  // dearer than the best: least squares do not make up for it

/// From one fit along the ways of its numbers.
class ProfileWays {
 public:
  ProfileWays(const LeastSquaresProblem& problem, const LeastSquaresFit& from)
      : problem_(problem),
        from_(from),
        covariance_(covariance_at(problem, from.x)),
        steps_(problem, from.x) {}

  /// The best that is seen on the way of a number.
  LeastSquaresFit best_on_way(std::size_t place) const {
    LeastSquaresFit best{from_.x, from_.cost + hopeless};
    for (const double move : moves) {
      const LeastSquaresFit fit = fit_from(moved(place, move));
      if (fit.cost < best.cost) best = fit;
    }
    return best;
  }

 private:
  Numbers moved(std::size_t place, double deviations) const {
    const double per_deviation = deviations / std::sqrt(covariance_(place, place));
    Numbers x = from_.x;
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += per_deviation * covariance_(i, place);
    return x;
  }

  LeastSquaresFit fit_from(Numbers x) const {
    const double most = from_.cost + hopeless;
    const double cost = cost_of(problem_, x, most);
    if (cost >= most) return {std::move(x), cost};
    Numbers nearer = steps_.step_from(x);
    const double nearer_cost = cost_of(problem_, nearer, cost);
    if (nearer_cost < cost) return {std::move(nearer), nearer_cost};
    return {std::move(x), cost};
  }

  const LeastSquaresProblem& problem_;
  const LeastSquaresFit& from_;
  Covariance covariance_;
  NearbySteps steps_;
};

}  // namespace

Numbers profile_search(const LeastSquaresProblem& problem, const Numbers& x,
                       const std::vector<bool>& moved, const std::function<bool()>& go_on) {
  constexpr int iterations = 3;
  constexpr std::size_t most_fitted = 5;  // of the places
  constexpr double no_matter = 1;
  LeastSquaresFit best{x, cost_of(problem, x)};
  for (double before = HUGE_VAL; before - best.cost > no_matter && go_on();) {
    before = best.cost;
    const LeastSquaresFit from = best;
    const ProfileWays ways(problem, from);
    std::vector<LeastSquaresFit> seen;
    for (std::size_t place = 0; place < moved.size(); ++place)
      if (moved[place] && go_on()) seen.push_back(ways.best_on_way(place));
    std::ranges::sort(seen, {}, &LeastSquaresFit::cost);
    seen.resize(std::min(seen.size(), most_fitted));
    for (const LeastSquaresFit& one : seen) {
      if (one.cost >= from.cost + hopeless || !go_on()) break;
      LeastSquaresFit fit = least_squares(problem, one.x, iterations);
      if (fit.cost < best.cost) best = std::move(fit);
    }
  }
  return best.x;
}

}  // namespace sim
