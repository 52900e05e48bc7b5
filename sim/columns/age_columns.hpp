#pragma once
// How old what is known of others is: three columns of AgeCounts.
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/columns/column.hpp"
#include "sim/counting/age_counts.hpp"

namespace sim {

struct AgeColumns {
  std::string prefix;               // of their names: "total_"
  std::string mean_is;              // the long name of the mean: "mean age at the other node"
  std::string where{};              // in the heading of the mean: "at base"; empty: no headings
  std::vector<std::string> over{};  // dimensions
  bool are_stored = true;
  std::optional<DrawnColumn> drawn{};  // the mean
};

/// `age_of` takes a point and the number of the element.
template <class Point, class AgeOf>
void add_age_columns(Columns<Point>& columns, const AgeColumns& how, AgeOf age_of) {
  constexpr double high_share = 0.95;
  const auto add = [&](const char* name, const char* unit, std::string long_name,
                       const RealText& text, const TextColumn& heading,
                       auto read) -> Column<Point>& {
    VariableFacts facts;
    if (how.are_stored) facts = {how.prefix + name, unit, std::move(long_name)};
    Column<Point>& column = columns.real(
        facts, [=](const Point& p, std::size_t i) { return read(age_of(p, i)); }, text);
    column.on(how.over);
    if (!how.where.empty()) column.headed(heading);
    return column;
  };
  add("age_mean_s", "s", how.mean_is, fixed(2), {{"mean age", how.where, "[s]"}, 9},
      [](const AgeCounts& age) { return age.mean_s(); })
      .drawing = how.drawn;
  add("age_p95_s", "s", "age that 95 % of the time is not exceeded", fixed(2),
      {{"95 % of", "ages", "[s]"}, 8},
      [=](const AgeCounts& age) { return age.quantile_s(high_share); });
  add("unknown_share", "1", "share of time in which nothing is known", percent_text,
      {{"nothing", "known", ""}, 8}, [](const AgeCounts& age) { return age.unknown_share(); });
}

}  // namespace sim
