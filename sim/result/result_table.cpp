#include "sim/result/result_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "sim/scenario/sweep.hpp"
#include "sim/text/json_answer.hpp"
#include "sim/text/row_table.hpp"

namespace sim {
namespace {

using Json = nlohmann::ordered_json;

/// Where a row is.
struct Place {
  std::size_t point, element;  // of the dimension that has rows; 0 without one
};

struct TableColumn {
  std::string name;
  std::function<Json(const Place&)> value;
};

Json number_json(double number) { return std::isfinite(number) ? Json(number) : Json(nullptr); }

Json value_of(const Dataset::Variable& variable, std::size_t cell) {
  if (const auto* numbers = std::get_if<std::vector<double>>(&variable.values))
    return number_json(numbers->at(cell));
  const std::int64_t number = std::get<std::vector<std::int64_t>>(variable.values).at(cell);
  if (!variable.is_choice) return number;
  if (number == no_choice) return nullptr;
  return variable.flags.at(static_cast<std::size_t>(number));
}

Json element_of(const Dataset::Dimension& dimension, std::size_t i) {
  if (const auto* texts = std::get_if<std::vector<std::string>>(&dimension.values))
    return texts->at(i);
  return number_json(std::get<std::vector<double>>(dimension.values).at(i));
}

/// The dimensions behind the axes of what each point has.
std::vector<std::string> own_dimensions(const Dataset& data) {
  std::vector<std::string> names;
  for (const Dataset::Variable& variable : data.variables) {
    if (!variable.on_axes) continue;
    for (const std::string& name : variable.dimensions)
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
  return names;
}

class ResultTable {
 public:
  explicit ResultTable(const Dataset& data) : data_(data) {
    const std::vector<std::string> own = own_dimensions(data);
    if (own.size() == 1) rows_ = &dimension_named(data, own.front());
    add_place();
    for (const Dataset::Variable& variable : data.variables)
      if (variable.on_axes) add(variable);
  }

  /// A row of which nothing is known.
  Json names() const {
    Json row;
    for (const TableColumn& column : columns_) row[column.name] = nullptr;
    return row;
  }

  void each_row(const std::function<void(const Json&)>& take) const {
    const std::size_t points = count_points(data_.axes), elements = rows_ ? rows_->size() : 1;
    for (std::size_t point = 0; point < points; ++point)
      for (std::size_t element = 0; element < elements; ++element) take(row_at({point, element}));
  }

 private:
  Json row_at(const Place& at) const {
    Json row;
    for (const TableColumn& column : columns_) row[column.name] = column.value(at);
    return row;
  }

  void add_place() {
    columns_.push_back({"experiment", [this](const Place&) { return Json(data_.experiment); }});
    columns_.push_back({"seed", [this](const Place&) { return Json(data_.seed); }});
    columns_.push_back({"point", [](const Place& at) { return Json(at.point); }});
    for (std::size_t i = 0; i < data_.axes.size(); ++i)
      columns_.push_back({dimension_name(data_.axes[i].key), [this, i](const Place& at) {
                            const Axis& axis = data_.axes[i];
                            const double value = point_coordinates(data_.axes, at.point)[i];
                            return axis.is_text() ? Json(coordinate_text(axis, value))
                                                  : number_json(value);
                          }});
    if (rows_)
      columns_.push_back(
          {rows_->facts.name, [this](const Place& at) { return element_of(*rows_, at.element); }});
  }

  void add(const Dataset::Variable& variable) {
    const std::size_t cells = cells_a_point(data_, variable);
    const bool has_rows = rows_ && !variable.dimensions.empty();
    if (has_rows || variable.dimensions.empty()) {
      columns_.push_back({variable.facts.name, [&variable, cells, has_rows](const Place& at) {
                            return value_of(variable,
                                            at.point * cells + (has_rows ? at.element : 0));
                          }});
      return;
    }
    for (std::size_t k = 0; k < cells; ++k)
      columns_.push_back({name_of_cell(variable, k), [&variable, cells, k](const Place& at) {
                            return value_of(variable, at.point * cells + k);
                          }});
  }

  /// "n_outcomes[inside]"
  std::string name_of_cell(const Dataset::Variable& variable, std::size_t cell) const {
    std::string elements;
    std::size_t cells = cells_a_point(data_, variable);  // of one element of the dimensions so far
    for (const std::string& name : variable.dimensions) {
      const Dataset::Dimension& dimension = dimension_named(data_, name);
      cells /= dimension.size();
      if (!elements.empty()) elements += ",";
      elements += value_text(dimension, cell / cells % dimension.size());
    }
    return variable.facts.name + "[" + elements + "]";
  }

  const Dataset& data_;
  const Dataset::Dimension* rows_ = nullptr;
  std::vector<TableColumn> columns_;
};

}  // namespace

std::string result_as_csv(const Dataset& data) {
  const ResultTable table(data);
  std::string text = csv_names(table.names());
  table.each_row([&](const Json& row) { text += csv_line(row); });
  return text;
}

std::string result_as_json_lines(const Dataset& data) {
  std::string text;
  ResultTable(data).each_row([&](const Json& row) { text += json_line(row); });
  return text;
}

bool is_csv_of_result(const std::filesystem::path& path) {
  return begins_as_csv(path, "experiment,seed,point,");
}

bool are_json_lines_of_result(const std::filesystem::path& path) {
  return begins_as_json_lines(path, "experiment");
}

}  // namespace sim
