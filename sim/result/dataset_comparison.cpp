#include "sim/result/dataset_comparison.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <map>
#include <utility>

#include "sim/counting/holm.hpp"
#include "sim/result/place_text.hpp"

namespace sim {
namespace {

/// A variable with its interval.
struct Ratios {
  std::vector<double> values, lows, highs;

  bool has(std::size_t i) const {
    return i < values.size() && i < lows.size() && i < highs.size() && std::isfinite(values[i]) &&
           std::isfinite(lows[i]) && std::isfinite(highs[i]);
  }
  Estimate operator[](std::size_t i) const { return {values[i], lows[i], highs[i]}; }
};

std::vector<double> cells_of(const Dataset& data, const std::string& name) {
  const Dataset::Variable* variable = find_variable(data, name);
  return variable == nullptr ? std::vector<double>() : numbers_of(*variable);
}

Ratios ratios_of(const Dataset& data, const std::string& name) {
  return {cells_of(data, name), cells_of(data, name + "_ci_low"),
          cells_of(data, name + "_ci_high")};
}

/// "receiver.range_m = 2 m, sender A": where each cell of a variable is.
std::vector<std::string> places_of(const Dataset& data, const Dataset::Variable& variable) {
  const std::vector<std::string> elements = element_texts(data, variable);
  const std::size_t cells = numbers_of(variable).size();
  std::vector<std::string> places;
  for (std::size_t i = 0; i < cells; ++i)
    places.push_back(joined(place_text(data, i / elements.size()), elements[i % elements.size()]));
  return places;
}

/// Cells are compared by their places, as the results may have other elements (devices).
void add_tests(DatasetComparison& comparison, const Dataset& a, const Dataset& b,
               const Dataset::Variable& variable) {
  const std::string& name = variable.facts.name;
  const Dataset::Variable* same = find_variable(b, name);
  if (same == nullptr || !variable.on_axes || !same->on_axes) return;
  const Ratios one = ratios_of(a, name), other = ratios_of(b, name);
  std::map<std::string, std::size_t> others;
  for (const std::string& place : places_of(b, *same)) others.emplace(place, others.size());
  const std::vector<std::string> places = places_of(a, variable);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto found = others.find(places[i]);
    if (found == others.end() || !one.has(i) || !other.has(found->second)) continue;
    const Estimate x = one[i], y = other[found->second];
    comparison.tests.push_back({name, places[i], x, y, p_value_of_estimates(x, y)});
  }
}

}  // namespace

std::size_t DatasetComparison::different() const {
  return static_cast<std::size_t>(std::ranges::count(tests, true, &CellTest::different));
}

double p_value_of_estimates(Estimate a, Estimate b) {
  if (a.value > b.value) std::swap(a, b);
  const double apart = b.value - a.value;
  if (apart == 0) return 1;
  const boost::math::normal normal;
  constexpr double level = 0.95;
  const double deviation =
      std::hypot(b.value - b.low, a.high - a.value) / quantile(normal, (1 + level) / 2);
  return deviation == 0 ? 0 : 2 * cdf(complement(normal, apart / deviation));
}

DatasetComparison compare(const Dataset& a, const Dataset& b, double alpha) {
  DatasetComparison comparison{.equal = dataset_digest(a) == dataset_digest(b)};
  for (const Dataset::Variable& variable : a.variables)
    if (find_variable(a, variable.facts.name + "_ci_low") != nullptr)
      add_tests(comparison, a, b, variable);
  std::vector<double> p_values;
  for (const CellTest& test : comparison.tests) p_values.push_back(test.p_value);
  const std::vector<bool> rejected = rejected_by_holm(p_values, alpha);
  for (std::size_t i = 0; i < rejected.size(); ++i) comparison.tests[i].different = rejected[i];
  return comparison;
}

}  // namespace sim
