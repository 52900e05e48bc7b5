// Points outside of a model's range are computed and flagged, never silently.
#include "sim/validity.hpp"

#include "scenarios.hpp"
#include "sim/parts.hpp"
#include "sim/report_table.hpp"

namespace sim {
namespace {

std::string names_at(const std::vector<std::string>& set) {
  return validity_names(link_of(set).outside);
}

TEST(Validity, TheDefaultsAreInside) { EXPECT_EQ(names_at({}), ""); }

TEST(Validity, EachLimitIsNamedWhereItIsLeftAndOnlyThere) {
  EXPECT_EQ(names_at({"receiver.range_m=0.04"}), "near");
  EXPECT_EQ(names_at({"receiver.range_m=0.06"}), "");
  EXPECT_EQ(names_at({"module.emax_w_per_m2=0.05"}), "emax");
  EXPECT_EQ(names_at({"ambient.irradiance_w_per_m2=101"}), "ambient");
  EXPECT_EQ(names_at({"ambient.daylight_lux=83000"}), "ambient");
  EXPECT_EQ(names_at({"ambient.daylight_lux=81000"}), "");
  EXPECT_EQ(names_at({"device.carrier_hz=44000"}), "carrier");
  EXPECT_EQ(names_at({"receiver.temperature_c=95"}), "temperature");
  EXPECT_EQ(names_at({"receiver.temperature_c=80"}), "");
  EXPECT_EQ(names_at({"receiver.supply_v=2"}), "supply");
  EXPECT_EQ(names_at({"receiver.supply_v=3.3"}), "");
  EXPECT_EQ(names_at({"receiver.supply_ripple_mv=600"}), "ripple");
  EXPECT_EQ(names_at({"receiver.supply_ripple_mv=600", "receiver.supply_ripple_at=10 kHz"}), "");
  // The message has six bits of light in a row: 590 cycles at 600 baud.
  EXPECT_EQ(names_at({"module.agc_pinned_cycles=589"}), "agc");
  EXPECT_EQ(names_at({"module.agc_pinned_cycles=591"}), "");
  EXPECT_EQ(names_at({"module.agc_pinned_cycles=589", "device.baud=601"}), "agc");
  EXPECT_EQ(names_at({"module.agc_pinned_cycles=589", "module.agc_attack_db_per_ms=0"}), "");
  EXPECT_EQ(names_at({"led.current_ma=250"}), "current");
}

TEST(Validity, NoShippedModuleIsOutsideUnderTypicalConditions) {
  for (const PartFile& part : list_parts({COSYS_SOURCE_DIR "/scenarios"})) {
    if (part.kind != "module") continue;
    const std::string names = names_at({"receiver.module=" + part.name});
    EXPECT_TRUE(names.empty() || names == "carrier" || names == "agc")
        << part.name << ": " << names;
    EXPECT_EQ(names == "agc", part.name.starts_with("tsop94")) << part.name;
  }
}

TEST(Validity, EveryLimitHasANameOfItsOwn) {
  std::string all = validity_names(~std::uint64_t{0});
  for (const ValidityLimit& limit : validity_limits()) {
    const auto at = all.find(limit.name);
    ASSERT_NE(at, std::string::npos);
    all.erase(at, std::string(limit.name).size());
  }
  EXPECT_EQ(all.find_first_not_of(','), std::string::npos) << all;
}

TEST(Validity, TheTableMarksThePointAndExplainsTheMark) {
  ExperimentResult result;
  result.points = {{.tally = {.n_frames = 4}, .outside = 3}, {.tally = {.n_frames = 4}}};
  EXPECT_TRUE(table_row({}, result.points[0], 0.95).ends_with("max_frames  ! near,emax\n"));
  EXPECT_TRUE(table_row({}, result.points[1], 0.95).ends_with("max_frames\n"));
  EXPECT_EQ(validity_notes(result),
            "! near: nearer than 5 cm LED and module are no points to each other\n"
            "! emax: more light than the module's sheet allows\n");
  result.points[0].outside = 0;
  EXPECT_EQ(validity_notes(result), "");
}

}  // namespace
}  // namespace sim
