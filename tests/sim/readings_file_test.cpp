// Files of readings, the shipped ones, and `cosys-sim locate` from outside.
#include "sim/location/readings_file.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "location_scenes.hpp"
#include "program.hpp"
#include "sim/components/parts.hpp"
#include "sim/failure.hpp"
#include "sim/location/location_trials.hpp"

namespace {

using sim::Position;
using sim::Reading;

const std::string shipped = COSYS_SOURCE_DIR "/scenarios/readings/";
const channel::PhotodiodeData bpw34{.name = "BPW34",
                                    .area_mm2 = 7.5,
                                    .responsivity_a_per_w = 0.6667,
                                    .dark_current_na = 2,
                                    .capacitance_pf = 25,
                                    .half_angle_deg = 65};

class ReadingsFile : public CommandLine {
 protected:
  std::vector<Reading> read(const std::string& text) const {
    write("r.csv", text);
    return sim::read_readings(path("r.csv"), bpw34, 0.02).readings;
  }

  /// The line that refuses such a file, its folder left out.
  std::string refusal(const std::string& text) const {
    try {
      read(text);
    } catch (const sim::Failure& failure) {
      std::string line = failure.what();
      const std::string where = path("r.csv").generic_string();
      const std::size_t at = line.find(where);
      return at == std::string::npos ? line : line.replace(at, where.size(), "r.csv");
    }
    return "accepted";
  }
};

TEST_F(ReadingsFile, ColumnsAreFoundByTheirNames) {
  const auto readings = read(
      "# what it is\n\nsigma,heading_deg,y_m,irradiance_mw_per_m2,x_m\r\n"
      "0.5, 90, 2, 30, 1\r\n# a remark\n0.25,-10,-2,0,-1");
  ASSERT_EQ(readings.size(), 2U);
  EXPECT_EQ(readings[0].receiver.x, 1);
  EXPECT_EQ(readings[0].receiver.y, 2);
  EXPECT_EQ(readings[0].receiver.z, 0.02);
  EXPECT_EQ(readings[0].receiver.yaw, dsp::degrees(90));
  EXPECT_NEAR(readings[0].irradiance_w_per_m2, 0.03, 1e-15);
  EXPECT_NEAR(readings[0].deviation_w_per_m2, 0.5e-3, 1e-15);
  EXPECT_FALSE(readings[0].has_bearing());
  EXPECT_EQ(readings[1].irradiance_w_per_m2, 0);
  EXPECT_NEAR(readings[1].deviation_w_per_m2, 0.25e-3, 1e-15);
}

TEST_F(ReadingsFile, ASpreadsheetsByteOrderMarkIsNoName) {
  EXPECT_EQ(read("\xEF\xBB\xBFx_m,y_m,heading_deg,irradiance_mw_per_m2,sigma\n1,1,1,1,1\n").size(),
            1U);
}

TEST_F(ReadingsFile, PhotocurrentIsOfThePhotodiode) {  // Vishay 81521: 50 uA at 10 W/m2
  const auto readings = read("x_m,y_m,heading_deg,photocurrent_ua,relative_sigma\n0,0,0,50,0.1\n");
  EXPECT_NEAR(readings[0].irradiance_w_per_m2, 10, 0.001);
  EXPECT_NEAR(readings[0].deviation_w_per_m2, 1, 1e-4);
}

TEST_F(ReadingsFile, BearingsMayBeMissingInALine) {
  const auto readings = read(
      "x_m,y_m,heading_deg,irradiance_mw_per_m2,sigma,bearing_deg,bearing_sigma_deg\n"
      "0,0,0,50,1,-30,2\n0,0,0,50,1,,\n");
  EXPECT_EQ(readings[0].bearing, dsp::degrees(-30));
  EXPECT_EQ(readings[0].bearing_deviation, dsp::degrees(2));
  EXPECT_FALSE(readings[1].has_bearing());
}

TEST_F(ReadingsFile, WrongColumnsAreNamed) {
  EXPECT_EQ(refusal("x_m,y_m,irradiance_mw_per_m2,sigma\n1,1,1,1\n"),
            "no column heading_deg in r.csv:1 (a reading needs it) add it");
  EXPECT_EQ(refusal("# a\nx,y_m,heading_deg,irradiance_mw_per_m2,sigma\n1,1,1,1,1\n"),
            "column \"x\" in r.csv:2 (no such column) did you mean x_m?");
  EXPECT_EQ(refusal("x_m,y_m,x_m,heading_deg,irradiance_mw_per_m2,sigma\n1,1,1,1,1,1\n"),
            "column x_m in r.csv:1 (it is there twice) leave one out");
  EXPECT_EQ(refusal("x_m,y_m,heading_deg,sigma\n1,1,1,1\n"),
            "no column irradiance_mw_per_m2 nor photocurrent_ua in r.csv:1 (a reading has exactly "
            "one of them) add one");
  EXPECT_EQ(refusal("x_m,y_m,heading_deg,photocurrent_ua,sigma,relative_sigma\n1,1,1,1,1,1\n"),
            "a column sigma and one relative_sigma in r.csv:1 (a reading has exactly one of them) "
            "leave one out");
  EXPECT_EQ(refusal("x_m,y_m,heading_deg,photocurrent_ua,sigma,bearing_deg\n1,1,1,1,1,1\n"),
            "no column bearing_sigma_deg in r.csv:1 (a reading needs it) add it");
}

TEST_F(ReadingsFile, WrongLinesAreNamed) {
  const auto line = [&](const std::string& text) {
    return refusal(
        "x_m,y_m,heading_deg,irradiance_mw_per_m2,sigma,bearing_deg,bearing_sigma_deg\n"
        "0,0,0,50,1,,\n" +
        text + "\n");
  };
  EXPECT_EQ(line("1,1,1"),
            "3 cells in r.csv:3 (there are 7 columns) write a number for each, leave an unmeasured "
            "bearing empty");
  EXPECT_EQ(line("1,a,1,1,1,,"),
            "y_m = \"a\" in r.csv:3 (not a number from -1e+09 to 1e+09) write a number such as "
            "0.25 or leave the "
            "line out");
  EXPECT_EQ(line("1,1,1,nan,1,,"),
            "irradiance_mw_per_m2 = \"nan\" in r.csv:3 (not a number from -1e+09 to 1e+09) write a "
            "number such as "
            "0.25 or leave the line out");
  EXPECT_EQ(line("1e300,1,1,1,1,,"),
            "x_m = \"1e300\" in r.csv:3 (not a number from -1e+09 to 1e+09) write a number such as "
            "0.25 or leave the line out");
  EXPECT_EQ(line("1,1,1,2,0,,"),
            "sigma = 0 in r.csv:3 (it is above 0) correct it or leave the line out");
  EXPECT_EQ(line("1,1,1,2,1,20,"),
            "half a bearing in r.csv:3 (it has a direction and a sigma) fill both cells or none");
  EXPECT_EQ(line("1,1,1,2,1,20,0"),
            "bearing_sigma_deg = 0 in r.csv:3 (it is above 0) correct it or leave the line out");
  for (const std::string value : {"0", "-2"})
    EXPECT_EQ(refusal("x_m,y_m,heading_deg,irradiance_mw_per_m2,relative_sigma\n1,1,1," + value +
                      ",0.1\n"),
              "relative_sigma of a reading of " + value +
                  " in r.csv:2 (its deviation would not be above 0) give sigma, in the unit of the "
                  "reading");
  EXPECT_EQ(refusal("# nothing\n"),
            "in r.csv (no readings) begin with x_m,y_m,heading_deg,irradiance_mw_per_m2,sigma and "
            "a line for each");
}

/// The model of which the shipped files say that they are.
sim::LightModel shipped_model() {
  const sim::PartSources parts{{COSYS_SOURCE_DIR "/scenarios"}, {}, {}};
  sim::LightModel model;
  model.emitter = sim::load_led("TSAL6200", parts, "LED").data;
  model.axial = channel::axial_intensity(model.emitter, dsp::Amperes(0.1));
  model.floor = sim::load_floor("indoor", parts, "floor").data;
  model.directivity.cosine_power = channel::cosine_power(dsp::degrees(65));
  return model;
}

void expect_drawn(const std::string& file, const Position& device) {
  const auto readings = sim::read_readings(shipped + file, bpw34, 0.01).readings;
  std::vector<channel::Pose> receivers;
  for (const Reading& reading : readings) receivers.push_back(reading.receiver);
  const auto drawn =
      sim::drawn_readings(sim::readings_of(shipped_model(), device, receivers, 0.03), {});
  for (std::size_t i = 0; i < readings.size(); ++i) {  // two digits behind the point of mW/m2
    EXPECT_NEAR(readings[i].irradiance_w_per_m2, drawn[i].irradiance_w_per_m2, 5.1e-6) << i;
    EXPECT_NEAR(readings[i].deviation_w_per_m2, drawn[i].deviation_w_per_m2, 5.1e-6) << i;
  }
}

TEST(ShippedReadings, AreWhatTheirCommentSays) {
  expect_drawn("four_receivers.csv", {1.4, 0.5});
  expect_drawn("two_on_a_line.csv", {1.5, 0.8});
}

using LocateCommand = ReadingsFile;

TEST_F(LocateCommand, FindsTheDeviceOfTheShippedFile) {
  const Outcome o = program({"locate", shipped + "four_receivers.csv", "--json"});
  EXPECT_EQ(o.code, 0) << o.err;
  const auto json = nlohmann::json::parse(o.out);
  EXPECT_EQ(json["outcome"], "located");
  ASSERT_EQ(json["places"].size(), 1U);
  const auto& place = json["places"][0];
  const sim::PositionCovariance covariance{
      place["covariance_m2"]["xx"], place["covariance_m2"]["xy"], place["covariance_m2"]["yy"]};
  const double dx = place["x_m"].get<double>() - 1.4, dy = place["y_m"].get<double>() - 0.5;
  EXPECT_LT(sim::squared_deviations(covariance, dx, dy), sim::chi_square_95);
  EXPECT_LT(covariance.rms(), 0.05);
  EXPECT_EQ(program({"locate", shipped + "four_receivers.csv"}).out.substr(0, 9), "located: ");
}

TEST_F(LocateCommand, WhatStaysOpenHasAnExitCodeOfItsOwn) {
  const Outcome o = program({"locate", shipped + "two_on_a_line.csv"});
  EXPECT_EQ(o.code, 4);
  EXPECT_EQ(o.out.substr(0, 11), "ambiguous: ");
  const Outcome sided = program({"locate", shipped + "two_on_a_line.csv", "--area", "-2,3,0.1,3"});
  EXPECT_EQ(sided.code, 0) << sided.out;
  write("one.csv", "x_m,y_m,heading_deg,irradiance_mw_per_m2,sigma\n0,0,0,40,1\n");
  const Outcome one = program({"locate", "one.csv", "--json"});
  EXPECT_EQ(one.code, 4);
  const auto json = nlohmann::json::parse(one.out);
  EXPECT_EQ(json["outcome"], "underdetermined");
  EXPECT_TRUE(json["places"][0]["ellipse_95"].is_null());
}

TEST_F(LocateCommand, RefusesInOneLine) {
  expect_refused({"locate", "none.csv"}, 2, "none.csv (no such file) check the path");
  expect_refused({"locate", shipped + "four_receivers.csv", "--area", "3,0,0,1"}, 2,
                 "--area (each range goes up) write x from,to and y from,to: -3,3,0,5");
  expect_refused({"locate", shipped + "four_receivers.csv", "--unknown-intensity"}, 2,
                 "a device of unknown intensity (it could be anywhere) say in what area to look");
}

}  // namespace
