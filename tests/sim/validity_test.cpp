// Points outside of a model's range are computed and flagged, never silently.
#include "sim/link/validity.hpp"

#include "link_table.hpp"
#include "scenarios.hpp"
#include "sim/components/parts.hpp"
#include "sim/link_experiment/link_notes.hpp"
#include "sim/scenario/flags.hpp"
#include "sim/text/text_file.hpp"

namespace sim {
namespace {

std::string names_at(const std::vector<std::string>& set) {
  return raised_names(validity_limits(), link_of(set).validity_flags);
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
  EXPECT_EQ(names_at({"receiver.module=TSOP31156", "receiver.supply_v=5.5"}), "");
  EXPECT_EQ(names_at({"receiver.module=TSOP31156", "receiver.supply_v=6"}), "supply");
  EXPECT_EQ(names_at({"receiver.module=TSSP96056", "receiver.supply_v=5"}), "supply");
  EXPECT_EQ(names_at({"receiver.module=TSSP96056", "receiver.supply_v=3.3"}), "");
  EXPECT_EQ(names_at({"receiver.module=TSDP34156", "receiver.supply_v=3.3"}), "supply");
  EXPECT_EQ(names_at({"receiver.supply_v=5.6"}), "supply");
  EXPECT_EQ(names_at({"receiver.module=GP1UX51QS", "receiver.population=true"}), "carrier,spread");
  EXPECT_EQ(names_at({"receiver.population=true"}), "");
  EXPECT_EQ(names_at({"receiver.range_m=70"}), "fringes");
  EXPECT_EQ(names_at({"receiver.range_m=50"}), "");
  EXPECT_EQ(names_at({"receiver.range_m=70", "floor.part=none"}), "");
  EXPECT_EQ(names_at({"receiver.range_m=70", "receiver.height_mm=1000"}), "");
  EXPECT_EQ(names_at({"receiver.supply_v=3.3"}), "");
  EXPECT_EQ(names_at({"receiver.supply_ripple_mv=600"}), "ripple");
  EXPECT_EQ(names_at({"receiver.supply_ripple_mv=600", "receiver.supply_ripple_at=10 kHz"}), "");
  // The message has six bits of light in a row: 590 cycles at 600 baud.
  EXPECT_EQ(names_at({"module.agc_pinned_cycles=589"}), "agc");
  EXPECT_EQ(names_at({"module.agc_pinned_cycles=591"}), "");
  EXPECT_EQ(names_at({"module.agc_pinned_cycles=589", "device.baud=601"}), "agc");
  EXPECT_EQ(names_at({"module.agc_pinned_cycles=589", "module.agc_attack_db_per_ms=0"}), "");
  EXPECT_EQ(names_at({"simulation.sample_rate_hz=472e3"}), "grid");
  EXPECT_EQ(names_at({"device.carrier_hz=60e3"}), "grid");
  EXPECT_EQ(names_at({"device.carrier_hz=60e3", "simulation.sample_rate_hz=960e3"}), "");
  EXPECT_EQ(names_at({"simulation.sample_rate_hz=472e3", "receiver.module=ideal-coherent"}), "");
  EXPECT_EQ(names_at({"led.current_ma=250"}), "current");
  EXPECT_EQ(names_at({"led.current_ma=150"}), "");
  EXPECT_EQ(names_at({"led.current_ma=150", "device.carrier_duty=0.9"}), "current");
  EXPECT_EQ(names_at({"led.current_ma=0.5"}), "current");
}

TEST(Validity, DecisionsEndWhereTheirNormalsDo) {
  const auto names_decided = [](const std::string& ebn0_db, const std::string& fidelity) {
    return names_at({"receiver.module=ideal-coherent", "simulation.fidelity=" + fidelity,
                     "receiver.ebn0_db=" + ebn0_db});
  };
  EXPECT_EQ(names_decided("15", "decision"), "");
  EXPECT_EQ(names_decided("15.2", "decision"), "tail");
  EXPECT_EQ(names_decided("16", "waveform"), "");
}

std::string names_beside(const std::string& disturbance) {
  const LoadedScenario scenario = loaded("[disturbance.other]\nkind = " + disturbance);
  return raised_names(validity_limits(), make_link(point_scenario(scenario, {})).validity_flags);
}

TEST(Validity, OtherLightsCount) {
  EXPECT_EQ(names_beside("'carrier'\ncarrier_hz = 50000"), "");
  EXPECT_EQ(names_beside("'remote'\ncarrier_hz = 38000"), "rejection");
  EXPECT_EQ(names_beside("'remote'\ncarrier_hz = 56000"), "");
  EXPECT_EQ(names_beside("'carrier'\nirradiance_w_per_m2 = 51"), "emax");
  EXPECT_EQ(names_beside("'fluorescent'\nballast_hz = 29000"), "");
  EXPECT_EQ(names_beside("'fluorescent'"), "rejection");
  EXPECT_EQ(names_beside("'ripple'\nirradiance_w_per_m2 = 100"), "ambient");
}

TEST(Validity, ColoursThatNoSheetShowsAreNamed) {
  const auto names = [](const std::string& module, double nm) {
    Scenario s = loaded("", {"receiver.module=" + module}).base;
    s.emitter.wavelength_nm = nm;
    return raised_names(validity_limits(), make_link(s).validity_flags);
  };
  EXPECT_EQ(names("TSOP38256", 950), "");
  EXPECT_EQ(names("TSOP38256", 870), "colour");
  EXPECT_EQ(names("TSOP4856", 870), "");
  EXPECT_EQ(names("TSOP4856", 700), "colour");
}

TEST(Validity, AMatchedReceiverHasNoLimitsOfAModule) {
  EXPECT_EQ(names_at({"receiver.module=ideal-coherent", "receiver.supply_v=5",
                      "receiver.temperature_c=50", "device.carrier_hz=20000"}),
            "");
  EXPECT_EQ(names_at({"receiver.ebn0_db=10", "receiver.range_m=0.02", "led.current_ma=250"}), "");
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
  std::string all = raised_names(validity_limits(), ~std::uint64_t{0});
  for (const ValidityLimit& limit : validity_limits()) {
    const auto at = all.find(limit.name);
    ASSERT_NE(at, std::string::npos);
    all.erase(at, std::string(limit.name).size());
  }
  EXPECT_EQ(all.find_first_not_of(','), std::string::npos) << all;
}

TEST(Validity, TheDocsListEveryLimit) {
  const std::string docs = read_text_file(COSYS_SOURCE_DIR "/scenarios/README.md", "docs");
  for (const ValidityLimit& limit : validity_limits())
    EXPECT_NE(docs.find("`" + std::string(limit.name) + "`"), std::string::npos) << limit.name;
}

TEST(Validity, TheTableMarksThePointAndExplainsTheMark) {
  LinkResult result;
  result.points = {{.tally = {.n_frames = 4}, .validity_flags = 3}, {.tally = {.n_frames = 4}}};
  EXPECT_TRUE(link_row(result.points[0]).ends_with("max_frames  ! near,fringes\n"));
  EXPECT_TRUE(link_row(result.points[1]).ends_with("max_frames\n"));
  EXPECT_EQ(mark_notes(result),
            "! near: nearer than 5 cm LED and module are no points to each other\n"
            "! fringes: direct and mirrored light interfere that far out\n");
  result.points[0].validity_flags = 0;
  EXPECT_EQ(mark_notes(result), "");
}

}  // namespace
}  // namespace sim
