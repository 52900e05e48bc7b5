#pragma once
// The columns of a result as variables of a Dataset, for HDF5, JSON and the page.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "sim/columns/column.hpp"
#include "sim/columns/label_index.hpp"
#include "sim/result/dataset.hpp"

namespace sim {

template <class Point>
class ColumnsDataset {
 public:
  ColumnsDataset(Dataset& data, const Columns<Point>& columns, const std::vector<Point>& points)
      : data_(data), columns_(columns), points_(points) {
    for (const ColumnDimension<Point>& dimension : columns.dimensions())
      indices_.push_back(index_of(dimension));
  }

  void add_all() {
    for (std::size_t i = 0; i < indices_.size(); ++i)
      if (!indices_[i].empty())
        data_.dimensions.push_back(indices_[i].dimension(columns_.dimensions()[i].facts));
    const std::string* list = nullptr;
    for (const Column<Point>& column : columns_.all()) {
      if (!column.is_stored() || !has_elements(column)) continue;
      if (is_on_list(column) && (list == nullptr || *list != column.over.front())) {
        list = &column.over.front();
        add_points_of(column);
      }
      add(column);
    }
  }

 private:
  using Labels = std::vector<std::vector<Label>>;  // of a point, of each of a column's dimensions

  LabelIndex index_of(const ColumnDimension<Point>& dimension) const {
    LabelIndex index;
    std::size_t n = 0;
    for (const Point& point : points_)
      for (const Label& label : dimension.labels(point))
        index.add(dimension.is_list ? Label(static_cast<double>(n++)) : label);
    return index;
  }

  std::size_t place_of(const std::string& name) const {
    const auto& dimensions = columns_.dimensions();
    const auto found =
        std::ranges::find(dimensions, name, [](const auto& d) { return d.facts.name; });
    return static_cast<std::size_t>(found - dimensions.begin());
  }

  bool has_elements(const Column<Point>& column) const {
    return std::ranges::none_of(
        column.over, [&](const std::string& name) { return indices_[place_of(name)].empty(); });
  }

  bool is_on_list(const Column<Point>& column) const {
    return !column.over.empty() && columns_.dimensions()[place_of(column.over.front())].is_list;
  }

  Labels labels_of(const Column<Point>& column, const Point& point) const {
    Labels labels;
    for (const std::string& name : column.over)
      labels.push_back(columns_.dimensions()[place_of(name)].labels(point));
    return labels;
  }

  /// The cells of all points; those of elements that a point does not have stay `nothing`.
  template <class T, class Read>
  std::vector<T> cells(const Column<Point>& column, T nothing, const Read& read) const {
    std::vector<T> values;
    for (const Point& point : points_) {
      const Labels labels = labels_of(column, point);
      if (is_on_list(column)) {
        for (std::size_t i = 0; i < labels.front().size(); ++i)
          values.push_back(static_cast<T>(read(point, i)));
        continue;
      }
      const std::size_t begin = values.size();
      values.resize(begin + cells_a_point(column), nothing);
      if (!point.reached() && !column.is_known_before) continue;
      for (std::size_t i = 0; i < elements(labels); ++i)
        values[begin + cell_of(column, labels, i)] = static_cast<T>(read(point, i));
    }
    return values;
  }

  std::size_t cells_a_point(const Column<Point>& column) const {
    std::size_t n = 1;
    for (const std::string& name : column.over) n *= indices_[place_of(name)].size();
    return n;
  }

  static std::size_t elements(const Labels& labels) {
    std::size_t n = 1;
    for (const auto& each : labels) n *= each.size();
    return n;
  }

  /// Where a point's element is among those of all points.
  std::size_t cell_of(const Column<Point>& column, const Labels& labels,
                      std::size_t element) const {
    std::size_t cell = 0, stride = 1;
    for (std::size_t d = labels.size(); d-- > 0;) {
      const LabelIndex& index = indices_[place_of(column.over[d])];
      cell += stride * index[labels[d][element % labels[d].size()]];
      element /= labels[d].size();
      stride *= index.size();
    }
    return cell;
  }

  template <class T>
  void add_variable(const Column<Point>& column, VariableFacts facts, std::vector<T> values,
                    std::vector<std::string> flags = {}) {
    data_.variables.push_back(
        {std::move(facts), !is_on_list(column), column.over, std::move(values), std::move(flags)});
  }

  /// Whose the elements of a list are, before the first column on it.
  void add_points_of(const Column<Point>& on_list) {
    std::vector<std::int64_t> numbers;
    for (std::size_t p = 0; p < points_.size(); ++p)
      numbers.resize(numbers.size() + labels_of(on_list, points_[p]).front().size(),
                     static_cast<std::int64_t>(p));
    add_variable(on_list, {on_list.over.front() + "_point", "1", "point of the sweep"},
                 std::move(numbers));
  }

  void add(const Column<Point>& column) {
    std::visit([&](const auto& kind) { add(column, kind); }, column.kind);
  }

  void add(const Column<Point>& column, const typename Column<Point>::Count& count) {
    add_variable(column, column.facts, cells<std::int64_t>(column, 0, count.read));
  }

  void add(const Column<Point>& column, const typename Column<Point>::Flags& flags) {
    add_variable(column, column.facts, cells<std::int64_t>(column, 0, flags.read), flags.names);
  }

  void add(const Column<Point>& column, const typename Column<Point>::Real& real) {
    add_variable(column, column.facts, cells<double>(column, unknown, real.read));
  }

  void add(const Column<Point>& column, const typename Column<Point>::Ratio& ratio) {
    const auto add_part = [&](const char* suffix, std::string long_name, double Estimate::*part) {
      add_variable(column, {column.facts.name + suffix, column.facts.unit, std::move(long_name)},
                   cells<double>(column, unknown, [&](const Point& point, std::size_t i) {
                     return ratio.read(point, i).*part;
                   }));
    };
    add_part("", column.facts.long_name, &Estimate::value);
    add_part("_ci_low", "lower end of its 95 % interval", &Estimate::low);
    add_part("_ci_high", "upper end of its 95 % interval", &Estimate::high);
  }

  void add(const Column<Point>& column, const typename Column<Point>::Words& words) {
    const std::size_t known = place_of(words.texts.name);
    LabelIndex texts = known < indices_.size() ? indices_[known] : LabelIndex();
    add_variable(column, column.facts,
                 cells<std::int64_t>(column, 0, [&](const Point& point, std::size_t i) {
                   return texts.add(words.read(point, i));
                 }));
    if (known == indices_.size()) data_.dimensions.push_back(texts.dimension(words.texts));
  }

  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  Dataset& data_;
  const Columns<Point>& columns_;
  const std::vector<Point>& points_;
  std::vector<LabelIndex> indices_;  // of the columns' dimensions
};

/// All points of a scenario. The first column counts the runs.
template <class Point>
Dataset dataset_of(const LoadedScenario& scenario, const std::string& command,
                   const Columns<Point>& columns, const std::vector<Point>& points) {
  Dataset data = dataset_of(scenario, command);
  ColumnsDataset<Point>(data, columns, points).add_all();
  for (const std::int64_t runs : std::get<std::vector<std::int64_t>>(data.variables.front().values))
    data.n_runs += static_cast<std::uint64_t>(runs);
  return data;
}

}  // namespace sim
