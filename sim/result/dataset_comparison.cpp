#include "sim/result/dataset_comparison.hpp"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "sim/counting/holm.hpp"
#include "sim/result/place_text.hpp"

namespace sim {
namespace {

/// A variable with its interval, of all points.
class Ratios {
 public:
  /// A cell: a point, and the elements of the variable's dimensions in words.
  using Place = std::pair<std::size_t, std::string>;

  Ratios(const Dataset& data, const Dataset::Variable& variable)
      : values_(numbers_of(variable)),
        lows_(numbers_named(data, variable.facts.name + "_ci_low")),
        highs_(numbers_named(data, variable.facts.name + "_ci_high")) {
    const std::vector<std::string> elements = element_texts(data, variable);
    for (std::size_t i = 0; i < values_.size(); ++i)
      places_.emplace_back(i / elements.size(), elements[i % elements.size()]);
  }

  const std::vector<Place>& places() const { return places_; }
  /// Nothing where it is not known.
  std::optional<Estimate> operator[](std::size_t i) const {
    if (i >= lows_.size() || i >= highs_.size()) return std::nullopt;
    const Estimate cell{values_[i], lows_[i], highs_[i]};
    const bool known =
        std::isfinite(cell.value) && std::isfinite(cell.low) && std::isfinite(cell.high);
    return known ? std::optional(cell) : std::nullopt;
  }

 private:
  std::vector<double> values_, lows_, highs_;
  std::vector<Place> places_;
};

/// Runs or trials of each point.
std::vector<double> runs_of(const Dataset& data) {
  const std::vector<double> runs = numbers_named(data, "n_runs");
  return runs.empty() ? numbers_named(data, "n_trials") : runs;
}

/// Of each point.
std::vector<double> degrees_of_freedom(const Dataset& a, const Dataset& b) {
  std::vector<double> degrees = runs_of(a);
  const std::vector<double> others = runs_of(b);
  for (std::size_t i = 0; i < degrees.size(); ++i)
    degrees[i] = std::max(1.0, std::min(degrees[i], i < others.size() ? others[i] : 0) - 1);
  return degrees;
}

const Dataset::Variable* ratio_named(const Dataset& data, const std::string& name) {
  const Dataset::Variable* variable = find_variable(data, name);
  const bool is_ratio =
      variable != nullptr && variable->on_axes && find_variable(data, name + "_ci_low") != nullptr;
  return is_ratio ? variable : nullptr;
}

/// Cells are compared by their places, as the results may have other elements (devices).
void add_tests(DatasetComparison& comparison, const Dataset& a, const Dataset& b,
               const std::string& name, const std::vector<double>& degrees) {
  const Dataset::Variable *of_a = ratio_named(a, name), *of_b = ratio_named(b, name);
  if (of_a == nullptr || of_b == nullptr) return;
  const Ratios one(a, *of_a), other(b, *of_b);
  std::map<Ratios::Place, std::size_t> others;
  std::size_t known = 0;  // in the other
  for (std::size_t i = 0; i < other.places().size(); ++i) {
    others.emplace(other.places()[i], i);
    known += other[i].has_value();
  }
  for (std::size_t i = 0; i < one.places().size(); ++i) {
    const auto& [point, elements] = one.places()[i];
    const auto found = others.find(one.places()[i]);
    const std::optional<Estimate> x = one[i],
                                  y = found == others.end() ? std::nullopt : other[found->second];
    known -= y.has_value();
    if (x && y)
      comparison.tests.push_back(
          {name, joined(place_text(a, point), elements), *x, *y,
           p_value_of_estimates(*x, *y, point < degrees.size() ? degrees[point] : 1)});
    else
      comparison.unknown += x || y ? 1 : 0;
  }
  comparison.unknown += known;
}

}  // namespace

std::size_t DatasetComparison::different() const {
  return static_cast<std::size_t>(std::ranges::count(tests, true, &CellTest::different));
}

double p_value_of_estimates(Estimate a, Estimate b, double degrees_of_freedom) {
  if (a.value > b.value) std::swap(a, b);
  const boost::math::students_t law(degrees_of_freedom);
  constexpr double level = 0.95;
  const double deviation =
      std::hypot(b.value - b.low, a.high - a.value) / quantile(law, (1 + level) / 2);
  const double deviations = (b.value - a.value) / deviation;
  if (std::isnan(deviations)) return 1;  // equal, or too large to tell
  return std::isinf(deviations) ? 0 : 2 * cdf(complement(law, deviations));
}

DatasetComparison compare(const Dataset& a, const Dataset& b, double alpha) {
  DatasetComparison comparison{.equal = dataset_digest(a) == dataset_digest(b)};
  const std::vector<double> degrees = degrees_of_freedom(a, b);
  for (const Dataset::Variable& variable : a.variables)
    add_tests(comparison, a, b, variable.facts.name, degrees);
  std::vector<double> p_values;
  for (const CellTest& test : comparison.tests) p_values.push_back(test.p_value);
  const std::vector<bool> rejected = rejected_by_holm(p_values, alpha);
  for (std::size_t i = 0; i < rejected.size(); ++i) comparison.tests[i].different = rejected[i];
  return comparison;
}

}  // namespace sim
