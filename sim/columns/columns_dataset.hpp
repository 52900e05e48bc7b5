#pragma once
// The columns of a result as variables of a Dataset, for HDF5, JSON and the page.
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
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
      elements_.push_back(elements_of(dimension));
  }

  void add_all() {
    for (std::size_t i = 0; i < elements_.size(); ++i)
      add_dimension(columns_.dimensions()[i].facts, elements_[i]);
    std::string list;
    for (const Column<Point>& column : columns_.all()) {
      if (!is_stored(column) || cells_a_point(column) == 0) continue;
      if (is_on_list(column) && list != column.over.front()) {
        list = column.over.front();
        add_owners(column);
      }
      std::visit([&](const auto& kind) { add(column, kind); }, column.kind);
    }
  }

 private:
  bool is_stored(const Column<Point>& column) const {
    return column.is_stored() && (column.is_kept == nullptr || column.is_kept(points_));
  }

  /// Of a dimension.
  struct Elements {
    bool is_list = false;
    std::size_t size = 0;                          // of all points
    LabelIndex index{};                            // but of a list
    std::vector<std::vector<std::size_t>> places;  // of each point's elements in it; but of a list
    std::vector<std::size_t> lengths;              // of each point
  };

  Elements elements_of(const ColumnDimension<Point>& dimension) const {
    Elements elements{.is_list = dimension.is_list(), .places = {}, .lengths = {}};
    for (const Point& point : points_) {
      if (elements.is_list) {
        elements.lengths.push_back(dimension.length(point));
        elements.size += elements.lengths.back();
        continue;
      }
      std::vector<std::size_t>& places = elements.places.emplace_back();
      for (const Label& label : dimension.labels(point))
        places.push_back(elements.index.add(label));
      elements.lengths.push_back(places.size());
      elements.size = elements.index.size();
    }
    return elements;
  }

  void add_dimension(const VariableFacts& facts, const Elements& elements) {
    if (elements.size == 0) return;
    if (!elements.is_list) return data_.dimensions.push_back(elements.index.dimension(facts));
    std::vector<double> numbers(elements.size);
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<double>(i);
    data_.dimensions.push_back({facts, std::move(numbers)});
  }

  const Elements& elements_named(const std::string& name) const {
    const std::optional<std::size_t> place = place_of(name);
    assert(place);
    return elements_[*place];
  }

  std::optional<std::size_t> place_of(const std::string& name) const {
    for (std::size_t i = 0; i < elements_.size(); ++i)
      if (columns_.dimensions()[i].facts.name == name) return i;
    return std::nullopt;
  }

  bool is_on_list(const Column<Point>& column) const {
    return !column.over.empty() && elements_named(column.over.front()).is_list;
  }

  /// Of a list all cells.
  std::size_t cells_a_point(const Column<Point>& column) const {
    std::size_t n = 1;
    for (const std::string& name : column.over) n *= elements_named(name).size;
    return n;
  }

  /// Calls `take(cell, value)` for each element of each point; cells of elements that a point does
  /// not have, and of points without a run, are left out.
  template <class Read, class Take>
  void read_cells(const Column<Point>& column, const Read& read, const Take& take) const {
    const bool on_list = is_on_list(column);
    const std::size_t each = cells_a_point(column);
    std::size_t begin = 0;
    for (std::size_t p = 0; p < points_.size(); ++p) {
      const std::size_t n = elements_at(column, p);
      if (points_[p].reached() || column.is_known_before)
        for (std::size_t i = 0; i < n; ++i)
          take(begin + (on_list ? i : cell_of(column, p, i)), read(points_[p], i));
      begin += on_list ? n : each;
    }
  }

  std::size_t all_cells(const Column<Point>& column) const {
    return cells_a_point(column) * (is_on_list(column) ? 1 : points_.size());
  }

  std::size_t elements_at(const Column<Point>& column, std::size_t point) const {
    std::size_t n = 1;
    for (const std::string& name : column.over) n *= elements_named(name).lengths[point];
    return n;
  }

  /// Where a point's element is among those of all points.
  std::size_t cell_of(const Column<Point>& column, std::size_t point, std::size_t element) const {
    std::size_t cell = 0, stride = 1;
    for (std::size_t d = column.over.size(); d-- > 0;) {
      const Elements& elements = elements_named(column.over[d]);
      const std::vector<std::size_t>& places = elements.places[point];
      cell += stride * places[element % places.size()];
      element /= places.size();
      stride *= elements.size;
    }
    return cell;
  }

  template <class T>
  void add_variable(const Column<Point>& column, VariableFacts facts, std::vector<T> values,
                    std::vector<std::string> flags = {}) {
    data_.variables.push_back(
        {std::move(facts), !is_on_list(column), column.over, std::move(values), std::move(flags)});
  }

  /// Adds the variable that says which point each element of a list belongs to. It stands before
  /// the list's first column.
  void add_owners(const Column<Point>& on_list) {
    std::vector<std::int64_t> numbers;
    for (std::size_t p = 0; p < points_.size(); ++p)
      numbers.resize(numbers.size() + elements_at(on_list, p), static_cast<std::int64_t>(p));
    add_variable(on_list, {on_list.over.front() + "_point", "1", "point of the sweep"},
                 std::move(numbers));
  }

  template <class Read>
  std::vector<std::int64_t> whole_numbers(const Column<Point>& column, const Read& read,
                                          std::int64_t not_known = 0) const {
    std::vector<std::int64_t> values(all_cells(column), not_known);
    read_cells(column, read, [&](std::size_t cell, auto value) {
      values[cell] = static_cast<std::int64_t>(value);
    });
    return values;
  }

  void add(const Column<Point>& column, const typename Column<Point>::Count& count) {
    add_variable(column, column.facts, whole_numbers(column, count.read));
  }

  void add(const Column<Point>& column, const typename Column<Point>::Flags& flags) {
    add_variable(column, column.facts, whole_numbers(column, flags.read), flags.names);
  }

  void add(const Column<Point>& column, const typename Column<Point>::Choice& choice) {
    const auto read = [&](const Point& point, std::size_t i) {
      const std::optional<std::size_t> index = choice.read(point, i);
      return index ? static_cast<std::int64_t>(*index) : no_choice;
    };
    add_variable(column, column.facts, whole_numbers(column, read, no_choice), choice.names);
    data_.variables.back().is_choice = true;
  }

  void add(const Column<Point>& column, const typename Column<Point>::Real& real) {
    std::vector<double> values(all_cells(column), unknown);
    read_cells(column, real.read, [&](std::size_t cell, double value) { values[cell] = value; });
    add_variable(column, column.facts, std::move(values));
  }

  void add(const Column<Point>& column, const typename Column<Point>::Ratio& ratio) {
    std::vector<double> values(all_cells(column), unknown), lows = values, highs = values;
    read_cells(column, ratio.read, [&](std::size_t cell, const Estimate& estimate) {
      values[cell] = estimate.value;
      lows[cell] = estimate.low;
      highs[cell] = estimate.high;
    });
    const VariableFacts& facts = column.facts;
    add_variable(column, facts, std::move(values));
    add_variable(column, {facts.name + "_ci_low", facts.unit, "lower end of its 95 % interval"},
                 std::move(lows));
    add_variable(column, {facts.name + "_ci_high", facts.unit, "upper end of its 95 % interval"},
                 std::move(highs));
  }

  void add(const Column<Point>& column, const typename Column<Point>::Words& words) {
    if (const std::optional<std::size_t> known = place_of(words.texts.name)) {
      const LabelIndex& index = elements_[*known].index;
      return add_variable(column, column.facts,
                          whole_numbers(column, [&](const Point& point, std::size_t i) {
                            return index[words.read(point, i)];
                          }));
    }
    LabelIndex index;
    add_variable(column, column.facts,
                 whole_numbers(column, [&](const Point& point, std::size_t i) {
                   return index.add(words.read(point, i));
                 }));
    data_.dimensions.push_back(index.dimension(words.texts));
  }

  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  Dataset& data_;
  const Columns<Point>& columns_;
  const std::vector<Point>& points_;
  std::vector<Elements> elements_;  // of the columns' dimensions
};

/// All points of a scenario. The first column counts the runs.
template <class Point>
Dataset dataset_of(const LoadedScenario& scenario, const std::string& command,
                   const Columns<Point>& columns, const std::vector<Point>& points) {
  assert(columns.all().front().over.empty());
  Dataset data = dataset_of(scenario, command);
  ColumnsDataset<Point>(data, columns, points).add_all();
  for (const std::int64_t runs : std::get<std::vector<std::int64_t>>(data.variables.front().values))
    data.n_runs += static_cast<std::uint64_t>(runs);
  return data;
}

}  // namespace sim
