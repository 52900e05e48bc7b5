#pragma once
// Results of the points of a sweep as variables of a dataset: NaN and 0 where a point was never
// finished.
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "sim/result/dataset.hpp"

namespace sim {

/// Point: a TrialPoint. Dimensions are those of the dataset, by their names.
template <class Point>
class TrialVariables {
 public:
  TrialVariables(Dataset& data, const std::vector<Point>& points) : data_(data), points_(points) {}

  /// What `read` says of each point, finished or not.
  template <class Read>
  void count(VariableFacts facts, Read read) {
    add<std::int64_t>(std::move(facts), "",
                      [&](const Point& point, std::size_t) { return read(point); });
  }

  template <class Read>
  void known(VariableFacts facts, Read read) {
    add<double>(std::move(facts), "", [&](const Point& point, std::size_t) { return read(point); });
  }

  template <class Read>
  void knowns(VariableFacts facts, const std::string& dimension, Read read) {
    add<double>(std::move(facts), dimension, read);
  }

  /// What `read` says of a result, and which element of the dimension it is asked for.
  template <class Read>
  void real(VariableFacts facts, Read read) {
    add<double>(std::move(facts), "", [&](const Point& point, std::size_t) {
      return point.result ? read(*point.result) : std::numeric_limits<double>::quiet_NaN();
    });
  }

  template <class Read>
  void reals(VariableFacts facts, const std::string& dimension, Read read) {
    add<double>(std::move(facts), dimension, [&](const Point& point, std::size_t i) {
      return point.result ? read(*point.result, i) : std::numeric_limits<double>::quiet_NaN();
    });
  }

  template <class Read>
  void counts(VariableFacts facts, const std::string& dimension, Read read) {
    add<std::int64_t>(std::move(facts), dimension, [&](const Point& point, std::size_t i) {
      return point.result ? static_cast<std::int64_t>(read(*point.result, i)) : 0;
    });
  }

 private:
  std::size_t size_of(const std::string& dimension) const {
    for (const Dataset::Dimension& each : data_.dimensions)
      if (each.facts.name == dimension) return each.size();
    return 1;
  }

  template <class T, class Read>
  void add(VariableFacts facts, const std::string& dimension, Read read) {
    std::vector<T> values;
    for (const Point& point : points_)
      for (std::size_t i = 0; i < size_of(dimension); ++i) values.push_back(read(point, i));
    std::vector<std::string> dimensions;
    if (!dimension.empty()) dimensions.push_back(dimension);
    data_.variables.push_back({std::move(facts), true, std::move(dimensions), std::move(values)});
  }

  Dataset& data_;
  const std::vector<Point>& points_;
};

}  // namespace sim
