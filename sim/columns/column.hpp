#pragma once
// The columns of a result. A column is declared once: its name, unit and meaning, its heading, and
// how it is read of a point. The terminal's table, HDF5, JSON and the page are made of it.
#include <algorithm>
#include <cassert>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "sim/columns/cell_text.hpp"
#include "sim/columns/estimate_text.hpp"
#include "sim/columns/text_table.hpp"
#include "sim/counting/statistics.hpp"
#include "sim/result/netcdf.hpp"
#include "sim/scenario/scenario.hpp"

namespace sim {

/// What an element of a dimension is called.
using Label = std::variant<double, std::string>;

/// How a column is drawn over the swept number. A ratio is drawn with its interval.
struct DrawnColumn {
  std::string title, label;  // of the chart, and along its axis
  bool logarithmic = false;
  std::string theory{};  // the name of a column of the same shape, drawn dashed; empty: none
};

/// What does not depend on the type of the points.
struct ColumnFacts {
  VariableFacts facts;              // no name: the column is in the terminal's table only
  std::vector<std::string> over{};  // its dimensions besides the axes, by their names
  TextColumn heading{{}, 0};        // of width 0: the column is not in the terminal's table
  int spared = 0;  // where a line has no room for all, those of the highest go first
  /// In the tables of a page, without its unit; empty: the heading in one line, or else the name.
  std::string page_heading{};
  std::optional<DrawnColumn> drawing{};
  bool is_text = false;
  RealText real_text{};  // of real numbers: how they are written in tables
  /// In the table of points: a column for each element of its one dimension, so headed.
  std::function<TextColumn(const Label&, std::size_t element)> spread{};
  /// Before the first run; otherwise a point without runs has 0 (counts) or NaN (reals).
  bool is_known_before = false;
  bool (*is_shown)(const LoadedScenario&) = nullptr;  // in the terminal's table; null: always

  bool is_stored() const { return !facts.name.empty(); }
  bool has_heading() const { return heading.width != 0; }
};

/// A value for each element that a point has of the column's dimensions, row-major; of a column
/// without dimensions, for the point.
template <class Point>
struct Column : ColumnFacts {
  template <class Value>
  using Reader = std::function<Value(const Point&, std::size_t element)>;

  /// Whole numbers. The digest of a result, but for a link's, is made of those that are stored.
  struct Count {
    Reader<std::uint64_t> read;
  };
  /// NaN is not known.
  struct Real {
    Reader<double> read;
  };
  /// Stored with the ends of its interval, as NAME_ci_low and NAME_ci_high.
  struct Ratio {
    Reader<Estimate> read;
    std::string (*text)(const Estimate&);
  };
  /// Stored as an index in the dimension `texts`, which has each text once.
  struct Words {
    Reader<std::string> read;
    VariableFacts texts;
  };
  /// A bit for each of `names`; in the table as `text` has it, where the column has a heading.
  struct Flags {
    Reader<std::uint64_t> read;
    std::vector<std::string> names;
    std::string (*text)(std::uint64_t mask);
  };

  /// One of `names`, or none of them where that is not known.
  struct Choice {
    Reader<std::optional<std::size_t>> read;
    std::vector<std::string> names;
  };

  using Kind = std::variant<Count, Real, Ratio, Words, Flags, Choice>;
  Kind kind;
  /// Whether a result of such points has it; null: each has.
  bool (*is_kept)(const std::vector<Point>&) = nullptr;

  Column& on(const std::vector<std::string>& dimensions) {
    over = dimensions;
    return *this;
  }
  Column& headed(const TextColumn& names_and_width) {
    heading = names_and_width;
    return *this;
  }
  Column& spared_before(int others) {
    spared = others;
    return *this;
  }
  Column& called(const std::string& on_page) {
    page_heading = on_page;
    return *this;
  }
  Column& spread_as(const std::function<TextColumn(const Label&, std::size_t)>& heading_of) {
    spread = heading_of;
    return *this;
  }
  Column& drawn(const DrawnColumn& how) {
    drawing = how;
    return *this;
  }
  Column& kept_if(bool (*condition)(const std::vector<Point>&)) {
    is_kept = condition;
    return *this;
  }
  Column& known_before() {
    is_known_before = true;
    return *this;
  }
  Column& shown_if(bool (*condition)(const LoadedScenario&)) {
    is_shown = condition;
    return *this;
  }
};

/// A dimension besides the axes: one with labels, or a list. The elements of the result are those
/// of all points: of a dimension with labels each label once, in the order in which they are met;
/// of a list all elements one behind the other, so a column on a list is not on the axes.
template <class Point>
struct ColumnDimension {
  VariableFacts facts;
  std::function<std::vector<Label>(const Point&)> labels;  // null: a list
  std::function<std::size_t(const Point&)> length{};       // of a list

  bool is_list() const { return !labels; }
};

/// The columns of an experiment in the order of its files and of its table. The first one is a
/// count without dimensions: how many runs, trials or frames a point has (n_runs, n_trials,
/// n_frames).
template <class Point>
class Columns {
 public:
  /// Readers take a point, or a point and the number of the element.
  template <class Read>
  Column<Point>& count(VariableFacts facts, Read read) {
    return add(std::move(facts),
               typename Column<Point>::Count{reader<std::uint64_t>(std::move(read))});
  }
  template <class Read>
  Column<Point>& real(VariableFacts facts, Read read, const RealText& text = significant(4)) {
    Column<Point>& column =
        add(std::move(facts), typename Column<Point>::Real{reader<double>(std::move(read))});
    column.real_text = text;
    return column;
  }
  template <class Read>
  Column<Point>& ratio(VariableFacts facts, Read read,
                       std::string (*text)(const Estimate&) = estimate_text) {
    return add(std::move(facts),
               typename Column<Point>::Ratio{reader<Estimate>(std::move(read)), text});
  }
  /// Texts; where they are stored, `texts` is the dimension that has them.
  template <class Read>
  Column<Point>& words(VariableFacts facts, Read read, VariableFacts texts = {}) {
    Column<Point>& column =
        add(std::move(facts),
            typename Column<Point>::Words{reader<std::string>(std::move(read)), std::move(texts)});
    column.is_text = true;
    return column;
  }
  template <class Read>
  Column<Point>& flags(VariableFacts facts, Read read, std::vector<std::string> names,
                       std::string (*text)(std::uint64_t) = nullptr) {
    return add(std::move(facts),
               typename Column<Point>::Flags{reader<std::uint64_t>(std::move(read)),
                                             std::move(names), text});
  }
  /// `read` gives an index in `names`, or nothing.
  template <class Read>
  Column<Point>& choice(VariableFacts facts, Read read, std::vector<std::string> names) {
    return add(std::move(facts),
               typename Column<Point>::Choice{reader<std::optional<std::size_t>>(std::move(read)),
                                              std::move(names)});
  }

  template <class Labels>
  void dimension(VariableFacts facts, Labels labels) {
    dimensions_.push_back({std::move(facts), std::move(labels)});
  }
  template <class Length>
  void list(VariableFacts facts, Length length) {
    dimensions_.push_back({std::move(facts), nullptr, std::move(length)});
  }

  /// Adds the stored columns of Base, from which Point is derived, without their headings.
  template <class Base>
  void add_stored(const Columns<Base>& columns) {
    for (const ColumnDimension<Base>& dimension : columns.dimensions())
      dimensions_.push_back({dimension.facts, dimension.labels, dimension.length});
    for (const Column<Base>& column : columns.all()) {
      if (!column.is_stored()) continue;
      assert(column.is_kept == nullptr);
      columns_.push_back({static_cast<const ColumnFacts&>(column), derived(column)});
      columns_.back().heading.width = 0;
      columns_.back().spread = nullptr;
    }
  }

  /// The one that is stored by that name, which is among them.
  Column<Point>& stored(const std::string& name) {
    return *std::ranges::find(columns_, name, [](const auto& c) { return c.facts.name; });
  }

  const std::vector<Column<Point>>& all() const { return columns_; }
  std::vector<ColumnFacts> facts() const { return {columns_.begin(), columns_.end()}; }
  const std::vector<ColumnDimension<Point>>& dimensions() const { return dimensions_; }
  /// The one of that name, which is among them.
  const ColumnDimension<Point>& dimension_of(const std::string& name) const {
    const auto found =
        std::ranges::find(dimensions_, name, [](const auto& d) { return d.facts.name; });
    assert(found != dimensions_.end());
    return *found;
  }

 private:
  template <class Value, class Read>
  static typename Column<Point>::template Reader<Value> reader(Read read) {
    if constexpr (std::invocable<const Read&, const Point&, std::size_t>)
      return [read = std::move(read)](const Point& point, std::size_t element) {
        return static_cast<Value>(read(point, element));
      };
    else
      return [read = std::move(read)](const Point& point, std::size_t) {
        return static_cast<Value>(read(point));
      };
  }

  Column<Point>& add(VariableFacts facts, typename Column<Point>::Kind kind) {
    columns_.push_back({{std::move(facts)}, std::move(kind)});
    return columns_.back();
  }

  template <class Base>
  static typename Column<Point>::Kind derived(const Column<Base>& column) {
    using From = Column<Base>;
    using To = Column<Point>;
    return std::visit(
        [](const auto& kind) -> typename To::Kind {
          using Held = std::decay_t<decltype(kind)>;
          if constexpr (std::is_same_v<Held, typename From::Count>)
            return typename To::Count{kind.read};
          else if constexpr (std::is_same_v<Held, typename From::Real>)
            return typename To::Real{kind.read};
          else if constexpr (std::is_same_v<Held, typename From::Ratio>)
            return typename To::Ratio{kind.read, kind.text};
          else if constexpr (std::is_same_v<Held, typename From::Words>)
            return typename To::Words{kind.read, kind.texts};
          else if constexpr (std::is_same_v<Held, typename From::Flags>)
            return typename To::Flags{kind.read, kind.names, kind.text};
          else
            return typename To::Choice{kind.read, kind.names};
        },
        column.kind);
  }

  std::vector<Column<Point>> columns_;
  std::vector<ColumnDimension<Point>> dimensions_;
};

}  // namespace sim
