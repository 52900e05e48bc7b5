#include "sim/section/dataset_cells.hpp"

#include <fmt/format.h>

#include <cmath>

#include "sim/columns/estimate_text.hpp"

namespace sim {
namespace {

std::vector<double> cells_of(const Dataset& data, const std::string& name) {
  std::vector<double> cells = numbers_named(data, name);
  for (double& cell : cells)
    if (std::isinf(cell)) cell = std::nan("");
  return cells;
}

bool are_counts(const Dataset& data, const std::string& name) {
  const Dataset::Variable* variable = find_variable(data, name);
  return variable != nullptr && std::holds_alternative<std::vector<std::int64_t>>(variable->values);
}

}  // namespace

DatasetCells::DatasetCells(const Dataset& data, const std::string& name)
    : values_(cells_of(data, name)),
      lows_(cells_of(data, name + "_ci_low")),
      highs_(cells_of(data, name + "_ci_high")),
      are_counts_(are_counts(data, name)) {}

double DatasetCells::operator[](std::size_t i) const {
  return i < values_.size() ? values_[i] : std::nan("");
}

std::uint64_t DatasetCells::count(std::size_t i) const {
  const double value = (*this)[i];
  return value > 0 && value < 9e18 ? static_cast<std::uint64_t>(value) : 0;
}

double DatasetCells::sum() const {
  double sum = 0;
  for (const double value : values_)
    if (!std::isnan(value)) sum += value;
  return sum;
}

bool DatasetCells::has_interval(std::size_t i) const {
  return i < lows_.size() && i < highs_.size() && !std::isnan(lows_[i]) && !std::isnan(highs_[i]);
}

std::string DatasetCells::text(std::size_t i) const {
  if (std::isnan((*this)[i])) return "-";
  if (has_interval(i)) return estimate_text({values_[i], lows_[i], highs_[i]});
  return are_counts_ ? fmt::format("{:.0f}", values_[i]) : fmt::format("{:.4g}", values_[i]);
}

}  // namespace sim
