// The tables of reports of arenas and guards: they hold what `run` prints, and a row's loss follows
// from its counts.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "experiment_report.hpp"
#include "page_tables.hpp"

namespace sim {
namespace {

using Row = std::map<std::string, std::string>;

const std::string guard = std::regex_replace(arena, std::regex("\"arena\""), "\"guard\"") +
                          "messages = \"AWAY 1\"\n[devices.third]\nx_m = 2\ny_m = 0.2\n"
                          "yaw_deg = 180\nmessages = \"THIRD\"\n";

void expect_columns(const Row& row, const std::vector<std::string>& columns) {
  for (const std::string& column : columns) EXPECT_TRUE(row.contains(column)) << column;
}

/// Two decimals at least. "< 1.2e-2" where nothing was lost.
void expect_loss(const Row& row, const std::string& delivered) {
  const double lost = 1 - std::stod(row.at(delivered)) / std::stod(row.at("messages sent"));
  const std::string& text = row.at("frame loss ratio");
  EXPECT_NEAR(text.starts_with("&lt; ") ? 0 : std::stod(text), lost, 5e-3);
}

class MessageTables : public ExperimentReport {
 protected:
  /// The counts of a device.
  static void expect_counts(const Row& row, const Json& counted, const std::string& delivered) {
    const auto names = counted["dimensions"]["device"].get<std::vector<std::string>>();
    const std::size_t i =
        static_cast<std::size_t>(std::ranges::find(names, row.at("device")) - names.begin());
    const auto count = [&](const std::string& name) {
      return counted["variables"][name]["values"][i].get<std::int64_t>();
    };
    EXPECT_EQ(row.at("messages sent"), std::to_string(count("n_messages") - count("n_silent")));
    EXPECT_EQ(row.at(delivered), std::to_string(count("n_delivered")));
  }
  static void expect_sums(const Row& row, const Json& counted, const std::string& delivered) {
    EXPECT_EQ(row.at("messages sent"),
              std::to_string(sum(counted, "n_messages") - sum(counted, "n_silent")));
    for (const auto& [column, name] :
         {std::pair<std::string, std::string>{"in reach", "n_in_reach"},
          {"overlapped", "n_overlapped"},
          {"captured", "n_captured"},
          {delivered, "n_delivered"}})
      EXPECT_EQ(row.at(column), std::to_string(sum(counted, name))) << column;
    expect_loss(row, delivered);
  }
};

TEST_F(MessageTables, OfAnArenaHoldWhatRunPrints) {
  const Json counted = run("a", arena);
  ASSERT_GT(sum(counted, "n_silent"), 0);
  const std::string page = report({"a.h5"});
  const std::vector<Row> points = table_under(page, "All numbers");
  ASSERT_EQ(points.size(), 1U);
  expect_sums(points[0], counted, "delivered");
  expect_columns(points[0],
                 {"devices", "first after [s]", "offered load G", "throughput S", "pure ALOHA S"});
  for (const char* heading : {"All devices", "Where messages were heard"}) {
    const std::vector<Row> devices = table_under(page, heading);
    ASSERT_EQ(devices.size(), 2U) << heading;
    for (const Row& row : devices) {
      expect_counts(row, counted, "delivered");
      expect_loss(row, "delivered");
    }
  }
  expect_columns(table_under(page, "All devices")[0],
                 {"highest irradiance [mW/m2]", "in reach", "overlapped", "captured",
                  "heard in runs", "first after [s]"});
}

TEST_F(MessageTables, OfASweepHaveTheSumsOfEachPoint) {
  const Json counted = run("a", arena + "[sweep]\ndevices.near.x_m = [1.5, 30]\n");
  const std::vector<Row> points = table_under(report({"a.h5"}), "All numbers");
  ASSERT_EQ(points.size(), 2U);
  for (std::size_t p = 0; p < 2; ++p) {
    const auto both = [&](const std::string& name) {
      return cell(counted, name, p, 0) + cell(counted, name, p, 1);
    };
    EXPECT_EQ(points[p].at("messages sent"), std::to_string(both("n_messages") - both("n_silent")));
    EXPECT_EQ(points[p].at("delivered"), std::to_string(both("n_delivered")));
  }
}

TEST_F(MessageTables, SayWhichPointLeavesTheRangeOfAModel) {
  const std::string near = std::regex_replace(arena, std::regex("x_m = 1.5"), "x_m = 1.01");
  run("a", near);
  const std::string page = report({"a.h5"});
  expect_has(page,
             "<p>Marked in the table of all numbers: of 1 point 1 outside of what a model is "
             "valid for.</p>");
  const std::vector<Row> points = table_under(page, "All numbers");
  ASSERT_EQ(points.size(), 1U);
  ASSERT_TRUE(points[0].contains("outside"));
  EXPECT_EQ(points[0].at("outside").find("! "), 0U);
  run("b", arena);
  const std::string far = report({"b.h5"});
  EXPECT_EQ(far.find("Marked in the table"), std::string::npos);
  EXPECT_FALSE(table_under(far, "All numbers")[0].contains("outside"));
}

TEST_F(MessageTables, OfAGuardHoldWhatRunPrints) {
  const Json counted = run("g", guard);
  const std::string page = report({"g.h5"});
  const std::vector<Row> points = table_under(page, "All numbers");
  ASSERT_EQ(points.size(), 1U);
  expect_sums(points[0], counted, "heard by the guard");
  EXPECT_EQ(points[0].at("messages"), std::to_string(sum(counted, "n_messages")));
  EXPECT_EQ(points[0].at("known to the base"), std::to_string(sum(counted, "n_known")));
  const std::vector<std::string> ages{"mean age at base [s]", "95 % of ages [s]", "nothing known"};
  expect_columns(points[0], ages);
  expect_columns(points[0], {"questions asked", "answered", "timed out"});
  std::map<std::string, std::string> variables;
  const std::vector<Row> devices = table_under(page, "All devices");
  for (const Row& row : devices) {
    expect_counts(row, counted, "heard by the guard");
    expect_columns(row, ages);
    variables[row.at("device")] = row.at("variable");
  }
  EXPECT_EQ(variables, (Row{{"near", "IND"}, {"away", "AWAY"}, {"third", "THIRD"}}));
}

TEST_F(MessageTables, OfAGuardHaveTheAgesThatRunPrints) {
  write("g.toml", guard);
  const Outcome o = program({"run", "g.toml", "-q", "-o", "g.h5"});
  ASSERT_EQ(o.code, 0) << o.err;
  const std::string page = report({"g.h5"});
  const Row row = table_under(page, "All numbers").at(0);
  const double mean_s = std::stod(row.at("mean age at base [s]"));
  const double p95_s = std::stod(row.at("95 % of ages [s]"));
  const std::string printed = fmt::format(" {:.2f} ", mean_s);
  EXPECT_NE(o.out.find(printed), std::string::npos) << printed << o.out;
  EXPECT_NE(o.out.find(fmt::format(" {:.2f} ", p95_s)), std::string::npos) << o.out;
  EXPECT_NE(o.out.find(" " + row.at("nothing known") + " "), std::string::npos) << o.out;
  expect_has(page, fmt::format("<p>What it knows is {:.3g} s old on average, {:.3g} s or less for "
                               "95 % of the time.</p>",
                               mean_s, p95_s));
  expect_has(page, "<p>For " + row.at("nothing known") +
                       " of the time, as a mean of all devices, it knows nothing of a device.</p>");
  expect_has(page, "<p>Nothing is known most often of away: 100.0 % of the time.</p>");
}

TEST_F(MessageTables, OfAGuardCompareNoDeviceWithItself) {
  run("g", std::regex_replace(guard.substr(0, guard.find("[devices.away]")),
                              std::regex("silent.*\n"), ""));
  const std::string page = report({"g.h5"});
  expect_has(page, "<p>What it knows is ");
  for (const char* words : {"is oldest of", "most often of"})
    EXPECT_EQ(page.find(words), std::string::npos) << words;
}

TEST_F(MessageTables, OfAGuardNameNoDeviceOfSeveralThatAreAlike) {
  run("g", guard + "[devices.far]\nx_m = 60\ny_m = 0\nmessages = \"FAR 1\"\n");
  const std::string page = report({"g.h5"});
  EXPECT_EQ(page.find("most often of"), std::string::npos) << "away as little as far";
  expect_has(page, "is oldest of");
}

TEST_F(MessageTables, OfASweptGuardSayWhereItsKnowledgeIsOldest) {
  run("g", guard + "[sweep]\nguard.transmit_every_ms = [200, 1000]\n");
  const std::string page = report({"g.h5"});
  expect_has(page, "<p>The mean age of what it knows is least at guard.transmit_every_ms = ");
  expect_has(page,
             "<p>The share of time in which it knows nothing of a device, as a mean of all "
             "devices, is least at ");
}

}  // namespace
}  // namespace sim
