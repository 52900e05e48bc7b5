#include "sim/location/gauss_newton.hpp"

#define ARMA_WARN_LEVEL 0  // a singular step is an outcome here, not news for stderr
#include <algorithm>
#include <armadillo>
#include <cmath>
#include <optional>

namespace sim {
namespace {

constexpr int most_steps = 100, most_halvings = 40;

// What chi-square can still fall by, in its own units, where a descent is over: a position good to
// 1e-4 deviations. On the corner of a tabulated curve the slopes jump and no step falls; a
// position good to a thirtieth of a deviation then is as far as one can get.
constexpr double converged_fall = 1e-8, corner_fall = 1e-3;

struct Step {
  std::array<double, 3> by{};
  double fall = 0;  // of chi-square, if all were linear
};

/// The shortest least-squares step, of unknowns in units of their columns' lengths; rows that do
/// not determine all unknowns leave the others where they are.
std::optional<Step> full_step(const std::vector<MisfitRow>& rows, bool intensity_unknown) {
  const arma::uword unknowns = intensity_unknown ? 3 : 2;
  arma::mat slopes(rows.size(), unknowns);
  arma::vec misfit(rows.size());
  for (arma::uword i = 0; i < slopes.n_rows; ++i) {
    misfit(i) = rows[i].misfit;
    for (arma::uword j = 0; j < unknowns; ++j) slopes(i, j) = rows[i].slope[j];
  }
  arma::rowvec scale = arma::sqrt(arma::sum(arma::square(slopes), 0));
  scale.replace(0.0, 1.0);
  const arma::mat scaled = slopes.each_row() / scale;
  arma::mat inverse;
  if (!scaled.is_finite() || !arma::pinv(inverse, scaled, 1e-6)) return std::nullopt;
  const arma::vec step = inverse * misfit;
  Step result{.fall = arma::accu(arma::square(scaled * step))};
  for (arma::uword j = 0; j < unknowns; ++j) result.by[j] = step(j) / scale(j);
  return result;
}

Unknowns moved(const Unknowns& from, const Step& step, double share) {
  return {{from.at.x + share * step.by[0], from.at.y + share * step.by[1]},
          from.intensity + share * step.by[2]};
}

bool allowed(const LeastSquares& problem, const Unknowns& u) {
  return problem.area.contains(u.at) && u.intensity > 0 &&
         nearest_receiver(problem.readings, u.at) >= least_distance_m;
}

/// Takes the longest halving of a step by which chi-square falls; false if there is none.
bool take(const LeastSquares& problem, const ScatteredLight& scattered, const Step& step,
          Minimum& here) {
  double share = 1;
  for (int halving = 0; halving < most_halvings; ++halving, share /= 2) {
    const Unknowns next = moved(here.at, step, share);
    if (!allowed(problem, next)) continue;
    const double fallen = chi_square(problem.model, problem.readings, scattered, next);
    if (!(fallen < here.chi_square)) continue;
    here.at = next;
    here.chi_square = fallen;
    return true;
  }
  return false;
}

}  // namespace

bool Area::contains(const Position& p) const {
  return x_min <= p.x && p.x <= x_max && y_min <= p.y && p.y <= y_max;
}

Minimum descend(const LeastSquares& problem, const ScatteredLight& scattered,
                const Unknowns& start) {
  Minimum here{start, chi_square(problem.model, problem.readings, scattered, start)};
  for (int i = 0; i < most_steps && !here.converged; ++i) {
    const auto rows = misfit_rows(problem.model, problem.readings, scattered, here.at);
    const auto step = full_step(rows, problem.intensity_unknown);
    if (!step) return here;
    const bool taken = take(problem, scattered, *step, here);
    here.converged = step->fall < (taken ? converged_fall : corner_fall);
    if (!taken) return here;
  }
  return here;
}

}  // namespace sim
