#include "sim/fit/global_search.hpp"

#include <nlopt.h>

#include <algorithm>
#include <memory>

namespace sim {
namespace {

struct Search {
  const LeastSquaresProblem& problem;
  const std::vector<SearchedNumber>& numbers;
  Numbers x;

  double cost(const double* at) {
    for (std::size_t i = 0; i < numbers.size(); ++i) x[numbers[i].place] = at[i];
    return cost_of(problem, x);
  }
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
  Search search{problem, numbers, start};
  nlopt_set_lower_bounds(optimiser.get(), low.data());
  nlopt_set_upper_bounds(optimiser.get(), high.data());
  nlopt_set_min_objective(optimiser.get(), cost_at, &search);
  nlopt_set_maxeval(optimiser.get(), evaluations);
  nlopt_srand(seed);
  double cost = 0;
  nlopt_optimize(optimiser.get(), at.data(), &cost);
  search.cost(at.data());
  return search.x;
}

}  // namespace sim
