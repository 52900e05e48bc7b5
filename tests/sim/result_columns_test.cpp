// Columns as variables of a dataset and as tables, of points of the tests' own.
#include <gtest/gtest.h>

#include <cmath>

#include "sim/columns/columns_dataset.hpp"
#include "sim/columns/columns_table.hpp"
#include "tests/sim/scenarios.hpp"

namespace sim {
namespace {

struct Box {
  std::string colour;
  std::uint64_t balls;
};

struct Room {
  std::vector<double> coordinates{};
  std::uint64_t runs = 0;
  std::vector<Box> boxes{};
  std::vector<std::string> visitors{};
  double area = 0;

  bool reached() const { return runs > 0; }
};

struct Hall : Room {
  double height = 3;
};

std::vector<Label> colours(const Room& room) {
  std::vector<Label> names;
  for (const Box& box : room.boxes) names.emplace_back(box.colour);
  return names;
}

Columns<Room> room_columns() {
  Columns<Room> columns;
  columns.dimension({"colour", "", "boxes"}, colours);
  columns.dimension({"side", "1", "halves"}, [](const Room&) {
    return std::vector<Label>{1.0, 2.0};
  });
  columns.list({"visit", "1", "visits"}, [](const Room& r) { return r.visitors.size(); });
  columns.count({"n_runs", "1", "runs"}, [](const Room& r) { return r.runs; })
      .headed({{"", "", "runs"}, 6});
  columns.real({"area", "m2", "area"}, [](const Room& r) { return r.area; })
      .known_before()
      .headed({{"", "area", "[m2]"}, 8});
  columns.real({"per_run", "1", "balls of the first box a run"}, [](const Room& r) {
    return static_cast<double>(r.boxes.at(0).balls) / static_cast<double>(r.runs);
  });
  columns
      .count({"n_balls", "1", "balls"},
             [](const Room& r, std::size_t i) { return r.boxes[i].balls; })
      .on({"colour"})
      .headed({{"", "", "balls"}, 6});
  columns.words({}, [](const Room& r, std::size_t i) { return r.boxes[i].colour; })
      .on({"colour"})
      .headed({{"", "", "box"}, -3});
  columns
      .real({"half", "1", "balls of a half"},
            [](const Room& r, std::size_t i) {
              return static_cast<double>(r.boxes[i / 2].balls) + static_cast<double>(i % 2) / 10;
            })
      .on({"colour", "side"});
  columns
      .words({"visit_name", "1", "index in name"},
             [](const Room& r, std::size_t i) { return r.visitors[i]; }, {"name", "", "visitors"})
      .on({"visit"});
  columns
      .words({"visit_colour", "1", "index in colour"},
             [](const Room& r, std::size_t) { return r.boxes.back().colour; },
             {"colour", "", "boxes"})
      .on({"visit"});
  return columns;
}

const std::vector<Room>& rooms() {
  static const std::vector<Room> all{{.coordinates = {1},
                                      .runs = 2,
                                      .boxes = {{"red", 4}, {"blue", 6}},
                                      .visitors = {"Ann"},
                                      .area = 10},
                                     {.coordinates = {2}, .area = 20},
                                     {.coordinates = {3},
                                      .runs = 5,
                                      .boxes = {{"green", 1}, {"red", 3}},
                                      .visitors = {"Bob", "Ann"},
                                      .area = 30}};
  return all;
}

LoadedScenario three_points() { return loaded("[sweep]\nreceiver.range_m = [1, 2, 3]\n"); }

template <class T>
std::vector<T> cells(const Dataset& data, const std::string& name) {
  const Dataset::Variable* variable = find_variable(data, name);
  return variable == nullptr ? std::vector<T>() : std::get<std::vector<T>>(variable->values);
}

using Counts = std::vector<std::int64_t>;
using Reals = std::vector<double>;
using Texts = std::vector<std::string>;

TEST(Columns, CountTheRunsOfAllPoints) {
  const Dataset data = dataset_of(three_points(), "", room_columns(), rooms());
  EXPECT_EQ(cells<std::int64_t>(data, "n_runs"), (Counts{2, 0, 5}));
  EXPECT_EQ(data.n_runs, 7U);
}

TEST(Columns, OfAPointWithoutRunsKnowWhatIsKnownBefore) {
  const Dataset data = dataset_of(three_points(), "", room_columns(), rooms());
  EXPECT_EQ(cells<double>(data, "area"), (Reals{10, 20, 30}));
  const Reals ratios = cells<double>(data, "per_run");
  EXPECT_EQ(ratios[0], 2);
  EXPECT_TRUE(std::isnan(ratios[1]));
}

TEST(Columns, OfADimensionHaveEachElementOnce) {
  const Dataset data = dataset_of(three_points(), "", room_columns(), rooms());
  EXPECT_EQ(std::get<Texts>(dimension_named(data, "colour").values),
            (Texts{"red", "blue", "green"}));
  EXPECT_EQ(cells<std::int64_t>(data, "n_balls"), (Counts{4, 6, 0, 0, 0, 0, 3, 0, 1}));
  const Reals halves = cells<double>(data, "half");
  ASSERT_EQ(halves.size(), 18U);
  EXPECT_EQ(halves[1], 4.1) << "red, second";
  EXPECT_EQ(halves[16], 1) << "green of the third point, first";
  EXPECT_TRUE(std::isnan(halves[4])) << "the first point has no green box";
}

TEST(Columns, OfAListStandOneBehindTheOther) {
  const Dataset data = dataset_of(three_points(), "", room_columns(), rooms());
  EXPECT_EQ(cells<std::int64_t>(data, "visit_point"), (Counts{0, 2, 2}));
  EXPECT_EQ(std::get<Texts>(dimension_named(data, "name").values), (Texts{"Ann", "Bob"}));
  EXPECT_EQ(cells<std::int64_t>(data, "visit_name"), (Counts{0, 1, 0}));
  EXPECT_EQ(cells<std::int64_t>(data, "visit_colour"), (Counts{1, 0, 0})) << "blue, red, red";
  EXPECT_FALSE(find_variable(data, "visit_name")->on_axes);
  EXPECT_TRUE(find_variable(data, "half")->on_axes);
}

TEST(Columns, OfWhatNoPointHasAreNone) {
  const std::vector<Room> empty{{.coordinates = {1}, .runs = 1, .boxes = {{"red", 1}}},
                                {.coordinates = {2}},
                                {.coordinates = {3}}};
  const Dataset data = dataset_of(three_points(), "", room_columns(), empty);
  for (const char* name : {"visit_point", "visit_name", "visit_colour"})
    EXPECT_EQ(find_variable(data, name), nullptr) << name;
  EXPECT_TRUE(std::ranges::none_of(data.dimensions, [](const Dataset::Dimension& d) {
    return d.facts.name == "visit" || d.facts.name == "name";
  }));
}

TEST(Columns, OfWhatAPointIsDerivedFromAreTakenWithoutHeadings) {
  Columns<Hall> columns;
  columns.add_stored(room_columns());
  columns.real({"height", "m", "height"}, [](const Hall& h) { return h.height; })
      .headed({{"", "height", "[m]"}, 7});
  const std::vector<Hall> halls(3, Hall{rooms()[0]});
  const Dataset data = dataset_of(three_points(), "", columns, halls);
  EXPECT_EQ(cells<double>(data, "height"), (Reals{3, 3, 3}));
  EXPECT_EQ(cells<std::int64_t>(data, "n_balls"), (Counts{4, 6, 4, 6, 4, 6}));
  const std::string head = PointTable(columns, three_points(), halls[0]).head();
  EXPECT_NE(head.find("height"), std::string::npos);
  EXPECT_EQ(head.find("runs"), std::string::npos);
}

TEST(PointTable, HasTheHeadedColumnsInTheirOrder) {
  const PointTable table(room_columns(), three_points(), rooms()[0]);
  EXPECT_EQ(table.head(),
            "  receiver\n"
            "   range_m              area\n"
            "       [m]    runs      [m2]\n");
  EXPECT_EQ(table.row(rooms()[2]), "         3       5        30\n");
}

TEST(PointTable, SpreadsADimensionElementByElement) {
  Columns<Room> columns;
  columns.dimension({"colour", "", "boxes"}, colours);
  const auto spread = [&](const std::string& head, double factor) {
    columns
        .real({head, "1", ""},
              [factor](const Room& r, std::size_t i) {
                return factor * static_cast<double>(r.boxes[i].balls);
              })
        .on({"colour"})
        .spread_as([head](const Label& colour, std::size_t) {
          return TextColumn{{"", std::get<std::string>(colour), head}, 6};
        });
  };
  spread("once", 1);
  spread("twice", 2);
  const PointTable table(columns, three_points(), rooms()[0]);
  EXPECT_NE(table.head().find("       [m]    once   twice    once   twice\n"), std::string::npos)
      << table.head();
  EXPECT_EQ(table.row(rooms()[0]), "         1       4       8       6      12\n");
}

// Of the columns of equal rank the last goes first, of others that of the highest.
TEST(PointTable, LeavesOutColumnsForWantOfRoom) {
  Columns<Room> columns;
  for (const auto& [name, spared] :
       {std::pair{"first", 0}, {"second", 1}, {"third-", 2}, {"last", 0}})
    columns.real({name, "", ""}, [](const Room&) { return 1.0; })
        .headed({{name, "part", "[m]"}, 8})
        .spared_before(spared);
  const auto left_out = [&](int room) {
    return PointTable(columns, three_points(), rooms()[0], room).left_out();
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(left_out(0), Names{}) << "any room";
  EXPECT_EQ(left_out(10 + 4 * 10), Names{});
  EXPECT_EQ(left_out(10 + 4 * 10 - 1), (Names{"thirdpart"}));
  EXPECT_EQ(left_out(10 + 2 * 10), (Names{"thirdpart", "second part"}));
  EXPECT_EQ(left_out(10 + 10), (Names{"thirdpart", "second part", "last part"}));
  EXPECT_EQ(left_out(1), (Names{"thirdpart", "second part", "last part"})) << "one stays";
  EXPECT_EQ(PointTable(columns, three_points(), rooms()[0], 20).row(rooms()[2]),
            "         3         1\n");
}

TEST(PointTable, LeavesOutWhatTheScenarioHasNoUseFor) {
  Columns<Room> columns;
  columns.count({"n_runs", "1", ""}, [](const Room& r) { return r.runs; })
      .headed({{"", "", "runs"}, 6})
      .shown_if([](const LoadedScenario& s) { return s.sweep.empty(); });
  const Room room{.coordinates = {}, .runs = 1};
  EXPECT_EQ(PointTable(columns, three_points(), room).head().find("runs"), std::string::npos);
  EXPECT_NE(PointTable(columns, loaded(""), room).head().find("runs"), std::string::npos);
}

TEST(ElementTable, HasARowForEachElementThatThePointHas) {
  EXPECT_EQ(element_table(room_columns(), "colour", rooms()[2]),
            "\n balls  box\n     1  green\n     3  red\n");
}

}  // namespace
}  // namespace sim
