#include "sim/link_experiment/link_json.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>

#include "measured_point.hpp"
#include "sim/counting/statistics.hpp"
#include "sim/link_experiment/link_columns.hpp"
#include "tally_words.hpp"

namespace {

using sim::measured_point;
using sim::text_axes;

nlohmann::json json_of(const sim::LinkResult& result) {
  return nlohmann::json::parse(sim::to_json(result, sim::link_dataset(result), sim::rank(result)));
}

TEST(Json, HoldsAllCountsAndRates) {
  sim::LinkResult result;
  result.title = "a \"quoted\" title";
  result.seed = 18446744073709551615U;
  result.axes = {{"receiver.range_m", "m", "distance", {7.5, 8}}};
  result.points = {measured_point(), {}};
  result.points[1].coordinates = {8};
  const auto object = json_of(result);
  EXPECT_EQ(object["title"], result.title);
  EXPECT_EQ(object["seed"], result.seed);
  EXPECT_EQ(object["result_digest"], sim::result_digest(result));
  EXPECT_EQ(object["axes"][0]["values"], (std::vector<double>{7.5, 8}));
  const auto& point = object["points"][0];
  EXPECT_EQ(point["receiver.range_m"], 7.5);
  EXPECT_EQ(point["n_frames_lost"], 100);
  EXPECT_EQ(point["flr"], 0.1);
  EXPECT_EQ(point["stop_reason"], "max_frame_errors");
  for (const auto& column : sim::link_columns().all())
    if (column.is_stored()) {
      EXPECT_EQ(point.contains(column.facts.name), column.is_kept == nullptr) << column.facts.name;
    }
}

sim::LinkResult two_modules() {
  sim::LinkResult result;
  result.axes = text_axes;
  const std::vector<std::uint64_t> lost{0, 1000, 1000, 0, 0, 0};
  for (std::size_t i = 0; i < 6; ++i) {
    result.points.push_back(measured_point());
    result.points[i].coordinates = {i < 3 ? 0.0 : 1.0, 1.0 + static_cast<double>(i % 3)};
    result.points[i].tally.n_frames_lost = lost[i];
  }
  return result;
}

TEST(Json, ListsTextsAndWhereTheirLossCrosses) {
  const auto object = json_of(two_modules());
  EXPECT_EQ(object["axes"][0]["values"], text_axes[0].labels);
  EXPECT_EQ(object["points"][4]["receiver.module"], "a-longer-name");
  EXPECT_EQ(object["points"][4]["receiver.range_m"], 2);
  const auto expected = nlohmann::json::parse(R"([
    {"receiver.module": "a-longer-name", "along": "receiver.range_m", "flr": 0.01,
     "kind": "all_below", "at": null, "low": null, "high": null},
    {"receiver.module": "TSOP4856", "along": "receiver.range_m", "flr": 0.01,
     "kind": "jump", "at": null, "low": 1.0, "high": 2.0}])");
  auto crossings = object["crossings"];
  for (auto& crossing : crossings) {
    EXPECT_NEAR(crossing["not_ruled_out"].get<double>(), 0.0037, 1e-4) << "0 of 1000";
    crossing.erase("not_ruled_out");
  }
  EXPECT_EQ(crossings, expected);
}

TEST(Json, HasTheDoubtOfACrossing) {
  const sim::LinkResult result = two_modules();
  sim::Ranking ranking = sim::rank(result);
  const double infinity = std::numeric_limits<double>::infinity();
  ranking.rows[0].doubt = sim::RangeDoubt{"TSOP4856", 16, {{{1, 2}, {2, 3}, {3, infinity}}}};
  const auto crossings =
      nlohmann::json::parse(sim::to_json(result, sim::link_dataset(result), ranking))["crossings"];
  EXPECT_EQ(crossings[0]["doubt"],
            nlohmann::json::parse(R"({"part": "TSOP4856", "units": 16, "low": 1, "high": null})"));
  EXPECT_FALSE(crossings[1].contains("doubt"));
}

// The middle one of three units ends between 1 and 2 m.
TEST(Json, HasWhatUnitsSayTogether) {
  sim::LinkResult result;
  result.axes = {{sim::unit_key, "1", "", {1, 2, 3}}, {"receiver.range_m", "m", "", {1, 2}}};
  const std::vector<std::uint64_t> lost{0, 0, 0, 1000, 1000, 1000};
  for (std::size_t i = 0; i < lost.size(); ++i) {
    result.points.push_back(measured_point());
    result.points[i].coordinates = {1.0 + static_cast<double>(i / 2),
                                    1.0 + static_cast<double>(i % 2)};
    result.points[i].tally.n_frames_lost = lost[i];
  }
  EXPECT_EQ(json_of(result)["units"], nlohmann::json::parse(R"({"flr": 0.01,
    "shares": [{"receiver.range_m": 1, "units": 3, "carried": 2, "share": 0.6666666666666666},
               {"receiver.range_m": 2, "units": 3, "carried": 1, "share": 0.3333333333333333}],
    "ranges": [{"along": "receiver.range_m", "units": 3, "quantiles": [
      {"quantile": 0.1, "low": null, "high": 1},
      {"quantile": 0.5, "low": 1, "high": 2},
      {"quantile": 0.9, "low": 2, "high": null}]}]})"));
  EXPECT_FALSE(json_of(two_modules()).contains("units"));
}

TEST(Json, TextsCountInTheDigest) {
  sim::LinkResult result = two_modules();
  const std::string before = sim::result_digest(result);
  result.axes[0].labels[1] = "another";
  EXPECT_NE(sim::result_digest(result), before);
}

TEST(Json, NamesEachRateForWhatItIs) {
  sim::LinkResult result;
  result.points = {measured_point()};
  result.points[0].tally.n_frames_undetected = 3;
  const auto object = json_of(result)["points"][0];
  const sim::Tally& tally = result.points[0].tally;
  const auto expect = [&](const std::string& name, const sim::Estimate& e) {
    EXPECT_EQ(object[name], e.value);
    EXPECT_EQ(object[name + "_ci_low"], e.low);
    EXPECT_EQ(object[name + "_ci_high"], e.high);
  };
  expect("ber", sim::bit_error_ratio(tally, 0.95));
  expect("flr", sim::frame_loss_ratio(tally, 0.95));
  expect("uer", sim::undetected_error_ratio(tally, 0.95));
  EXPECT_EQ(object["irradiance_mw_per_m2"], 0.312);
  EXPECT_EQ(object["ambient_w_per_m2"], 0.6);
  EXPECT_EQ(object["snr_db"], 14.25);
  EXPECT_EQ(object["snr_bandwidth_hz"], 5000);
  EXPECT_EQ(object["ebn0_db"], 21.3);
  EXPECT_EQ(object["elapsed_s"], 2);
  EXPECT_EQ(object["simulated_s"], 620);
}

// Every counter under its own name: words of the tally are numbered.
TEST(Json, NamesEachCounterForWhatItIs) {
  sim::CounterWords words{};
  std::iota(words.begin(), words.end(), 1);
  words[0] = words[5] = 1000;  // n_bits and n_frames, no fewer than what went wrong with them
  sim::LinkResult result;
  result.points.resize(1);
  result.points[0].tally = sim::tally_of(words);
  const auto object = json_of(result)["points"][0];
  const std::vector<std::string> names{"n_bits",
                                       "n_bit_errors",
                                       "n_bytes",
                                       "n_byte_errors",
                                       "n_framing_errors",
                                       "n_frames",
                                       "n_frames_ok",
                                       "n_frames_lost",
                                       "n_frames_undetected",
                                       "n_frames_false",
                                       "n_frames_unheard",
                                       "n_frames_unended",
                                       "n_rejected_unprintable",
                                       "n_rejected_short",
                                       "n_rejected_not_hex",
                                       "n_rejected_checksum",
                                       "n_rejected_overlong",
                                       "n_frames_bit_errors",
                                       "sum_bit_errors_squared",
                                       "sum_bits_squared",
                                       "sum_bit_errors_times_bits"};
  ASSERT_EQ(names.size(), words.size());
  for (std::size_t i = 0; i < names.size(); ++i) EXPECT_EQ(object[names[i]], words[i]) << names[i];
}

TEST(Json, IsNullWhereNothingIsKnown) {
  sim::LinkResult result;
  result.title = "not \xff UTF-8";
  result.points = {{}};
  const auto point = json_of(result)["points"][0];
  EXPECT_EQ(point["n_frames"], 0);
  for (const char* name : {"ber", "flr_ci_low", "uer", "snr_db", "stop_reason"}) {
    EXPECT_TRUE(point[name].is_null()) << name;
  }
}

}  // namespace
