#include "sim/result/place_text.hpp"

#include <fmt/ranges.h>

#include <utility>
#include <variant>

#include "sim/scenario/sweep.hpp"
#include "sim/text/unit_text.hpp"

namespace sim {
namespace {

std::string element_text(const Dataset::Dimension& dimension, std::size_t i) {
  const bool is_text = std::holds_alternative<std::vector<std::string>>(dimension.values);
  return dimension.facts.name + (is_text ? " " : " = ") + value_text(dimension, i);
}

}  // namespace

std::string quantity(const Axis& axis, const std::string& value) {
  return axis.key + " = " + with_unit(value, axis.unit);
}

std::string place_text(const std::vector<Axis>& axes, const std::vector<double>& coordinates) {
  std::vector<std::string> places;
  for (std::size_t i = 0; i < axes.size(); ++i)
    places.push_back(quantity(axes[i], coordinate_text(axes[i], coordinates[i])));
  return fmt::format("{}", fmt::join(places, ", "));
}

std::string place_text(const Dataset& data, std::size_t point) {
  return place_text(data.axes, point_coordinates(data.axes, point));
}

std::string joined(const std::string& one, const std::string& other) {
  return one + (one.empty() || other.empty() ? "" : ", ") + other;
}

std::vector<std::string> element_texts(const Dataset& data, const Dataset::Variable& variable) {
  std::vector<std::string> texts{""};
  for (const std::string& name : variable.dimensions) {
    const Dataset::Dimension& dimension = dimension_named(data, name);
    std::vector<std::string> finer;
    for (const std::string& text : texts)
      for (std::size_t i = 0; i < dimension.size(); ++i)
        finer.push_back(joined(text, element_text(dimension, i)));
    texts = std::move(finer);
  }
  return texts;
}

}  // namespace sim
