#include "sim/columns/unit_values_text.hpp"

#include <cmath>
#include <utility>

#include "sim/columns/page_heading.hpp"
#include "sim/columns/text_table.hpp"
#include "sim/counting/sample_quantile.hpp"
#include "sim/result/place_text.hpp"
#include "sim/result/unit_spread.hpp"

namespace sim {
namespace {

/// Of which the table has a number for each point, or for each element of a point; null where it
/// has none, or a mark or choice.
const Dataset::Variable* tabled_variable(const Dataset& data, const ColumnFacts& column) {
  const bool is_tabled = column.spread || (column.has_heading() && column.over.empty());
  if (!is_tabled || !column.is_stored() || column.is_text) return nullptr;
  const Dataset::Variable* variable = find_variable(data, column.facts.name);
  return variable != nullptr && variable->on_axes && variable->flags.empty() ? variable : nullptr;
}

/// "detected, false_alarm = 0.01", and its quantiles over so many units.
std::vector<std::string> value_cells(const ColumnFacts& column, const std::string& element,
                                     const std::vector<double>& known) {
  const RealText text = column.real_text ? column.real_text : significant(4);
  std::vector<std::string> cells{std::to_string(known.size()),
                                 joined(page_heading(column), element)};
  for (const double share : spread_quantiles) cells.push_back(text(sample_quantile(known, share)));
  return cells;
}

class UnitValues {
 public:
  UnitValues(const Dataset& data, const std::vector<ColumnFacts>& columns)
      : data_(data),
        columns_(columns),
        axes_(without_unit(data.axes)),
        runs_(numbers_named(data, columns.front().facts.name)) {}

  std::string table() const {
    std::vector<std::vector<std::string>> rows;
    for (const UnitGroup& group : unit_groups(data_.axes))
      for (const ColumnFacts& column : columns_) add_rows(rows, group, column);
    return rows.empty() ? "" : text_table(headings(), rows);
  }

 private:
  std::vector<TextColumn> headings() const {
    std::vector<TextColumn> all = axis_columns(axes_);
    all.push_back({{"", "", "units"}, 6});
    all.push_back({{"", "", "of each"}, -1});
    all.push_back({{"", "10 %", "quantile"}, number_width});
    all.push_back({{"", "", "median"}, number_width});
    all.push_back({{"", "90 %", "quantile"}, number_width});
    return all;
  }

  void add_rows(std::vector<std::vector<std::string>>& rows, const UnitGroup& group,
                const ColumnFacts& column) const {
    const Dataset::Variable* variable = tabled_variable(data_, column);
    if (variable == nullptr) return;
    const std::vector<double> values = numbers_of(*variable);
    const std::vector<std::string> elements = element_texts(data_, *variable);
    for (std::size_t element = 0; element < elements.size(); ++element) {
      rows.push_back(coordinate_texts(axes_, group.coordinates));
      for (std::string& cell : value_cells(column, elements[element],
                                           known_values(values, group, element, elements.size())))
        rows.back().push_back(std::move(cell));
    }
  }

  /// Of the points that had runs.
  std::vector<double> known_values(const std::vector<double>& values, const UnitGroup& group,
                                   std::size_t element, std::size_t elements) const {
    std::vector<double> known;
    for (const std::size_t point : group.points) {
      const double value = values[point * elements + element];
      if (runs_[point] > 0 && std::isfinite(value)) known.push_back(value);
    }
    return known;
  }

  const Dataset& data_;
  const std::vector<ColumnFacts>& columns_;
  std::vector<Axis> axes_;
  std::vector<double> runs_;
};

}  // namespace

std::string unit_value_lines(const Dataset& data, const std::vector<ColumnFacts>& columns) {
  if (!has_units(data.axes) || find_variable(data, loss_name) != nullptr) return "";
  const std::string table = UnitValues(data, columns).table();
  return table.empty() ? "" : "units drawn within what nobody printed of their parts:\n" + table;
}

}  // namespace sim
