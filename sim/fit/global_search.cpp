#include "sim/fit/global_search.hpp"

#include <nlopt.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "sim/fit/lowest_costs.hpp"

namespace sim {
namespace {

/// The population is the cheapest points so far: of any other it is enough to know that it is
/// dearer than each of them.
class Search {
 public:
  Search(const LeastSquaresProblem& problem, const std::vector<SearchedNumber>& numbers, Numbers x)
      : problem_(problem), numbers_(numbers), x_(std::move(x)), cheapest_(population()) {}

  std::size_t population() const { return 10 * (numbers_.size() + 1); }  // as Kaelo and Ali have it
  const Numbers& x() const { return x_; }

  void move(const double* at) {
    for (std::size_t i = 0; i < numbers_.size(); ++i) x_[numbers_[i].place] = at[i];
  }

  double cost(const double* at) {
    move(at);
    const double cost = cost_of(problem_, x_, cheapest_.most());
    cheapest_.add(cost);
    return cost;
  }

 private:
  const LeastSquaresProblem& problem_;
  const std::vector<SearchedNumber>& numbers_;
  Numbers x_;
  LowestCosts cheapest_;
};

double cost_at(unsigned /*dimensions*/, const double* at, double* /*gradient*/, void* search) {
  return static_cast<Search*>(search)->cost(at);
}

}  // namespace

Numbers global_search(const LeastSquaresProblem& problem, const Numbers& start,
                      const std::vector<SearchedNumber>& numbers, int evaluations,
                      unsigned long seed) {
  const std::unique_ptr<nlopt_opt_s, void (*)(nlopt_opt)> optimiser(
      nlopt_create(NLOPT_GN_CRS2_LM, static_cast<unsigned>(numbers.size())), nlopt_destroy);
  std::vector<double> low, high, at;
  for (const SearchedNumber& number : numbers) {
    low.push_back(number.low);
    high.push_back(number.high);
    at.push_back(std::clamp(start[number.place], number.low, number.high));
  }
  Search search(problem, numbers, start);
  nlopt_set_lower_bounds(optimiser.get(), low.data());
  nlopt_set_upper_bounds(optimiser.get(), high.data());
  nlopt_set_min_objective(optimiser.get(), cost_at, &search);
  nlopt_set_population(optimiser.get(), static_cast<unsigned>(search.population()));
  nlopt_set_maxeval(optimiser.get(), evaluations);
  nlopt_srand(seed);
  double cost = 0;
  nlopt_optimize(optimiser.get(), at.data(), &cost);
  search.move(at.data());
  return search.x();
}

}  // namespace sim
