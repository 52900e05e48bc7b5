#include "sim/section/swept_rows.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sim/scenario/sweep.hpp"
#include "sim/section/swept_curves.hpp"

namespace sim {
namespace {

std::vector<std::size_t> axes_of_rows(const std::vector<Axis>& axes) {
  constexpr std::size_t most_rows = 60;
  std::vector<std::size_t> all(axes.size());
  std::iota(all.begin(), all.end(), 0);
  if (count_points(axes) <= most_rows) return all;
  return {*std::ranges::max_element(all, {}, [&](std::size_t i) { return axes[i].values.size(); })};
}

/// "all" of a single point.
std::string joined_words(const std::vector<std::string>& texts) {
  return texts.empty() ? "all" : fmt::format("{}", fmt::join(texts, ", "));
}

}  // namespace

SweptRows::SweptRows(const std::vector<Axis>& axes) : axes_(axes), over_(axes_of_rows(axes)) {}

std::string SweptRows::head() const {
  std::vector<std::string> names;
  for (const std::size_t i : over_) names.push_back(axis_name(axes_[i]));
  return joined_words(names);
}

std::string SweptRows::label(const std::vector<double>& coordinates) const {
  std::vector<std::string> texts;
  for (const std::size_t i : over_) texts.push_back(coordinate_text(axes_[i], coordinates[i]));
  return joined_words(texts);
}

std::vector<std::uint64_t> SweptRows::weighed(std::vector<std::uint64_t> counts) const {
  const auto all = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
  if (!joins_points() || all == 0) return counts;
  const double thousandth = static_cast<double>(all) / 1000;
  for (std::uint64_t& count : counts)
    count = static_cast<std::uint64_t>(std::llround(static_cast<double>(count) / thousandth));
  return counts;
}

}  // namespace sim
