// Arenas say where they leave the range of a model, as links do (sim/link/validity).
#include <nlohmann/json.hpp>

#include "arena_scenes.hpp"
#include "counted_points.hpp"
#include "gtest/gtest.h"
#include "sim/arena/arena_columns.hpp"
#include "sim/columns/columns_dataset.hpp"
#include "sim/columns/columns_table.hpp"
#include "sim/columns/validity_column.hpp"
#include "sim/link/validity.hpp"
#include "sim/result/dataset.hpp"
#include "sim/scenario/flags.hpp"

namespace sim {
namespace {

std::string validity_flags_of(const std::string& text, const std::vector<std::string>& set = {}) {
  return raised_names(validity_limits(), arena_of(text, set).validity_flags);
}

const std::string past = "[devices.one]\nx_m = 1\ny_m = 0.3\n[path]\nx_m = [0, 2]\n";

TEST(ArenaValidity, SaysWhenTheReceiverComesTooNear) {
  EXPECT_EQ(validity_flags_of(past), "");
  EXPECT_EQ(validity_flags_of(past, {"devices.one.y_m=0.04"}), "near");
  EXPECT_EQ(validity_flags_of(past, {"devices.one.y_m=0.04", "devices.one.x_m=-1"}),
            "");  // passed by
}

TEST(ArenaValidity, LooksAtEachDevicesOwnLedAndCarrier) {
  const std::string other = past + device("two", "3");
  EXPECT_EQ(validity_flags_of(other, {"devices.two.current_ma=500"}), "current");
  EXPECT_EQ(validity_flags_of(other, {"devices.two.carrier_error_ppm=190000"}), "carrier");
}

TEST(ArenaValidity, DevicesOutOfReachDoNotCount) {
  const std::string other = past + device("two", "900", "current_ma = 500");
  EXPECT_EQ(validity_flags_of(other), "");
}

TEST(ArenaValidity, IsInTheTableInItsNotesAndInTheFile) {
  const LoadedScenario scenario =
      loaded_arena(past + "[arena]\nruns = 1\n", {"devices.one.y_m=0.04,0.3"});
  const std::vector<ArenaPoint> points = counted_points(arena_measurement, scenario, {});
  EXPECT_NE(
      PointTable(arena_columns(), scenario, points.at(0)).row(points.at(0)).find("  ! near\n"),
      std::string::npos);
  EXPECT_EQ(PointTable(arena_columns(), scenario, points.at(1)).row(points.at(1)).find('!'),
            std::string::npos);
  const Dataset data = dataset_of(scenario, "", arena_columns(), points);
  EXPECT_EQ(validity_notes(data),
            "! near: nearer than 5 cm LED and module are no points to each other\n");
  const auto json = nlohmann::json::parse(dataset_json(data))["variables"]["outside_validity"];
  EXPECT_EQ(json["values"], nlohmann::json({1, 0}));
  EXPECT_EQ(json["flags"][0], "near");
}

}  // namespace
}  // namespace sim
