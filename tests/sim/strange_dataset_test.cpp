// Results that no run of ours wrote: of each experiment a small one is read back and written again
// with one thing strange, and its digest with it. A report then is a page, or refuses the file.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "program.hpp"
#include "sanitized.hpp"
#include "scenarios.hpp"
#include "sim/command/experiments.hpp"
#include "sim/page/page.hpp"
#include "sim/result/store.hpp"
#include "sim/result/stored_dataset.hpp"
#include "sim/scenario/sweep.hpp"
#include "small_experiments.hpp"

namespace sim {
namespace {

using Reals = std::vector<double>;
using Counts = std::vector<std::int64_t>;
using Texts = std::vector<std::string>;
using Variable = Dataset::Variable;
using test::Experiment;
using test::scenario_of;
using test::small_experiments;

/// What no cell of ours holds.
struct StrangeNumber {
  double real;
  std::int64_t count;
};
constexpr StrangeNumber strange_numbers[] = {
    {std::numeric_limits<double>::quiet_NaN(), -1},
    {-1, std::numeric_limits<std::int64_t>::min()},
    {1e300, 8'000'000'000'000'000'000},
    {std::numeric_limits<double>::infinity(), std::numeric_limits<std::int64_t>::max()}};

/// Each `step`th cell from the first on.
void fill(Variable& variable, const StrangeNumber& strange, std::size_t step) {
  const auto put = [&](auto& cells, auto number) {
    for (std::size_t i = 0; i < cells.size(); i += step) cells[i] = number;
  };
  if (auto* reals = std::get_if<Reals>(&variable.values))
    put(*reals, strange.real);
  else
    put(std::get<Counts>(variable.values), strange.count);
}

/// To other dimensions and of the other type, with cells of 1, 2, 3.
void move(const Dataset& data, Variable& variable, bool on_axes, const Texts& dimensions) {
  variable.on_axes = on_axes;
  variable.dimensions = dimensions;
  Counts counts(cells_a_point(data, variable) * (on_axes ? count_points(data.axes) : 1));
  std::iota(counts.begin(), counts.end(), 1);
  if (std::holds_alternative<Reals>(variable.values))
    variable.values = std::move(counts);
  else
    variable.values = Reals(counts.begin(), counts.end());
}

/// Where a number is none, with what is around it; empty where nowhere. Scripts are not looked at.
std::string none_in(const std::string& page) {
  const auto in_a_word = [](char c) { return std::islower(static_cast<unsigned char>(c)) != 0; };
  const std::string seen = page.substr(0, page.find("<script")) + '\n';
  for (const char* none : {"nan", "inf"})
    for (auto at = seen.find(none); at != std::string::npos; at = seen.find(none, at + 1))
      if (!in_a_word(seen[at - 1]) && !in_a_word(seen[at + 3])) return seen.substr(at - 60, 90);
  return "";
}

class StrangeDataset : public CommandLine,
                       public testing::WithParamInterface<std::tuple<Experiment, bool>> {
 protected:
  StrangeDataset() {
    static std::map<std::string, StoredDataset> of_scenarios;
    const std::string scenario = scenario_of(std::get<0>(GetParam()), std::get<1>(GetParam()));
    if (!of_scenarios.contains(scenario)) of_scenarios[scenario] = result_of(scenario);
    stored_ = of_scenarios[scenario];
  }

  static void expect_page(const StoredDataset& stored) {
    const ReportSection part = report_of("x", stored);
    EXPECT_EQ(none_in(page_as_html(page_of({part}))), "");
  }
  /// A page of what `read` gives, or a line that refuses it.
  template <class Read>
  static void expect_answer(const Read& read) {
    try {
      expect_page(read());
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.code(), ExitCode::bad_input);
      EXPECT_EQ(std::string(failure.what()).find('\n'), std::string::npos) << failure.what();
    } catch (const std::exception& other) {
      ADD_FAILURE() << other.what();
    }
  }
  void expect_answer_to_file(const Dataset& data) const {
    write_dataset(path("y.h5"), data, {"cosys-sim", "1", "c"});
    expect_answer([&] { return read_dataset(path("y.h5")); });
  }
  /// With each of its variables, one at a time, changed; but for the weekly run with some of them,
  /// and with others by the next change.
  template <class Change>
  void expect_answers(const std::string& what, const Change& change) {
    ++changes_;
    const std::size_t one_of = test::is_set("COSYS_WEEKLY") ? 1 : test::is_sanitized ? 4 : 2;
    for (std::size_t i = 0; i < stored_.data.variables.size(); ++i) {
      if ((i + changes_) % one_of != 0) continue;
      SCOPED_TRACE(stored_.data.variables[i].facts.name + " " + what);
      StoredDataset strange = stored_;
      change(strange.data.variables, strange.data.variables.begin() + static_cast<long>(i));
      expect_answer([&] { return strange; });
    }
  }

  StoredDataset stored_;

 private:
  StoredDataset result_of(const std::string& scenario) const {
    write("x.toml", scenario);
    const Outcome o = program({"run", "x.toml", "-q", "-o", "x.h5"});
    if (o.code != 0) throw std::runtime_error(o.err);
    return read_dataset(path("x.h5"));
  }

  std::size_t changes_ = 0;
};

TEST_P(StrangeDataset, WithAStrangeVariable) {
  expect_page(stored_);
  expect_answers("missing", [](auto& variables, auto variable) { variables.erase(variable); });
  // Half of all: of the one variable each cell, of the next every other one, and so on.
  std::size_t kind = 0;
  for (const StrangeNumber& strange : strange_numbers) {
    ++kind;
    expect_answers(fmt::format("of {}", strange.real), [&](auto& variables, auto variable) {
      const auto place = static_cast<std::size_t>(variable - variables.begin());
      fill(*variable, strange, 1 + (place + kind) % 2);
    });
  }
  std::vector<Texts> places{{}};
  for (const Dataset::Dimension& dimension : stored_.data.dimensions)
    places.push_back({dimension.facts.name});
  for (const Texts& place : places) {
    ++kind;
    expect_answers(fmt::format("on {}", fmt::join(place, "")), [&](auto& variables, auto variable) {
      const auto at = static_cast<std::size_t>(variable - variables.begin());
      move(stored_.data, *variable, (at + kind) % 2 == 0, place);
    });
  }
}

TEST_P(StrangeDataset, WithStrangeElementsOfADimension) {
  for (std::size_t i = 0; i < stored_.data.dimensions.size(); ++i) {
    SCOPED_TRACE(stored_.data.dimensions[i].facts.name);
    StoredDataset strange = stored_;
    Dataset::Dimension& dimension = strange.data.dimensions[i];
    dimension.values = Texts(dimension.size(), "a\nb<");
    expect_answer([&] { return strange; });
    dimension.values = Reals(dimension.size(), 1e300);
    expect_answer([&] { return strange; });
    dimension.values = Reals(dimension.size(), std::nan(""));
    expect_answer_to_file(strange.data);
  }
}

/// By name too: else it is refused at once (StoredDatasetTest).
TEST_P(StrangeDataset, WithTheScenarioOfAnother) {
  std::vector<Experiment> others(std::begin(small_experiments), std::end(small_experiments));
  others.push_back(
      {"link", "", "receiver.range_m = [1, 50]"});  // whose results are of another type
  for (const Experiment& other : others) {
    SCOPED_TRACE(other.name);
    Dataset strange = stored_.data;
    strange.scenario_toml = loaded(scenario_of(other, std::get<1>(GetParam()))).text;
    strange.experiment = other.name;
    expect_answer_to_file(strange);
  }
}

INSTANTIATE_TEST_SUITE_P(, StrangeDataset,
                         testing::Combine(testing::ValuesIn(small_experiments), testing::Bool()),
                         [](const auto& test) {
                           return std::string(std::get<0>(test.param).name) +
                                  (std::get<1>(test.param) ? "_swept" : "");
                         });

}  // namespace
}  // namespace sim
