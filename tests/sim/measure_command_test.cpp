// `cosys-sim fit CAPTURE` as users see it.
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <regex>
#include <sstream>

#include "played_plan.hpp"
#include "program.hpp"
#include "protocol/cosys.hpp"
#include "sim/components/parts.hpp"
#include "sim/fit/bench_notes.hpp"
#include "sim/fit/plan_schedule.hpp"

namespace {

const sim::PartSources parts_of_all{
    .folders = {std::filesystem::path(COSYS_SOURCE_DIR) / "scenarios"},
    .carried = {},
    .carrier = {}};

/// What a TSOP4856 of another attack made of the first steps of a minute's plan.
struct PlayedBench {
  channel::ModuleData module;
  sim::Plan plan;
  std::string text, output, both;

  explicit PlayedBench(std::size_t most_steps)
      : module(sim::load_module("TSOP4856", parts_of_all, "").data) {
    const double level = sim::bench_first_level(module);
    const auto led = sim::load_led("TSAL6200", parts_of_all, "").data;
    plan = sim::plan_of(sim::schedule_for(module, led, 1));
    plan.steps.resize(std::min(most_steps, plan.steps.size()));
    text = sim::plan_text(plan, sim::bench_remarks("TSOP4856", level));
    module.agc_attack_db_per_ms = 0.15;
    const sim::RecordedWire rx{"rx", true, sim::changes_of_output(plan, module, level)};
    output = sim::capture_of({rx});
    both = sim::capture_of({{"D7", false, sim::changes_of_mark(plan)}, rx});
  }
};

/// As many steps as find a plan in a recording: what is said of a fit, not what it finds.
constexpr std::size_t few_steps = 8;

class MeasureCommand : public CommandLine {
 protected:
  explicit MeasureCommand(std::size_t most_steps = few_steps) : bench_(most_steps) {
    write("plan.txt", bench_.text);
    write("capture.csv", bench_.output);
  }

  /// Not without a stop: what was measured is on the screen.
  Outcome measured(Words words) const {
    words.insert(words.begin(), "fit");
    const Outcome o = program(words);
    EXPECT_TRUE(o.code == 0 || o.code == 4) << o.err;
    EXPECT_EQ(o.err, "");
    return o;
  }

  PlayedBench bench_;
};

class MeasureCommandMinute : public MeasureCommand {
 protected:
  MeasureCommandMinute() : MeasureCommand(1000) {}
};

/// Of the answer as JSON.
nlohmann::json number_in(const Outcome& o, const std::string& key) {
  const auto told = nlohmann::json::parse(o.out);
  for (const nlohmann::json& number : told.at("numbers"))
    if (number.at("name") == key) return number;
  return {};
}

/// Rows of times in microseconds and the level of one wire.
std::string as_vcd(const std::string& rows) {
  std::string text = "$timescale 1 ns $end\n$var wire 1 ! rx $end\n$enddefinitions $end\n";
  std::istringstream lines(rows);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    const std::size_t comma = line.find(',');
    text += fmt::format("#{:.0f}\n{}!\n", 1e3 * std::stod(line), line.substr(comma + 1));
  }
  return text;
}

/// The fitted value of a line of the table; 0 where there is none.
double value_in(const std::string& table, const std::string& constant) {
  const std::size_t line = table.find("\n" + constant + " ");
  return line == std::string::npos ? 0 : std::stod(table.substr(line + 1 + constant.size()));
}

// What is written is read again, and a scenario runs with it.
TEST_F(MeasureCommandMinute, SaysTheConstantsAndWritesAPartThatRuns) {
  const Outcome o = measured({"capture.csv", "-o", "modules/mine.toml"});
  EXPECT_EQ(o.code, 0);
  EXPECT_TRUE(o.out.starts_with("constant  ")) << o.out;
  for (const char* word :
       {"\ncentre_hz ", "TSOP4856", "Read rx of capture.csv, by the plan plan.txt",
        "Emin is for 60.1 mW/m2 at the module in the plan's first step, as the "
        "plan plan.txt says",
        "Next: cosys-sim run ", "quickstart.toml --parts . --set receiver.module=mine\n"})
    EXPECT_NE(o.out.find(word), std::string::npos) << word << " in\n" << o.out;
  EXPECT_EQ(files(),
            (std::set<std::string>{"capture.csv", "modules", "modules/mine.toml", "plan.txt"}));
  const channel::ModuleData part =
      sim::load_module(
          "mine", {.folders = {folder(), parts_of_all.folders[0]}, .carried = {}, .carrier = {}},
          "")
          .data;
  EXPECT_NEAR(part.agc_attack_db_per_ms, value_in(o.out, "agc_attack_db_per_ms"), 1e-3);
  write_scenario("s.toml", "\"receiver.range_m\" = 0.5");
  const Outcome run = program({"run", "s.toml", "-q", "--set", "receiver.module=mine"});
  EXPECT_EQ(run.code, 0) << run.err;
  const Outcome shown = program({"parts", "mine", "--parts", "."});
  EXPECT_NE(shown.out.find("Measured by cosys-sim fit"), std::string::npos) << shown.out;
}

TEST_F(MeasureCommand, TakesTheIrradianceThatItIsTold) {
  const auto of = [&](const Words& words) {
    Words all{"capture.csv", "--json"};
    all.insert(all.end(), words.begin(), words.end());
    return nlohmann::json::parse(measured(all).out);
  };
  EXPECT_NEAR(of({})["first_level"]["mw_per_m2"].get<double>(), 60.1, 0.1);
  EXPECT_EQ(of({"--irradiance", "30"})["first_level"]["mw_per_m2"], 30);
  write("plan.txt", sim::plan_text(bench_.plan, {"of somebody who said no level"}));
  EXPECT_FALSE(of({}).contains("first_level"));
  EXPECT_NE(measured({"capture.csv"}).out.find("Emin is that of TSOP4856"), std::string::npos);
  write("plan.txt", "# first level: 20 mW/m2\n" + bench_.text);
  EXPECT_FALSE(of({}).contains("first_level")) << "no plan that this program wrote";
}

TEST_F(MeasureCommand, SaysWhatTheSketchLeftOut) {
  const char* words = "pairs of edges of capture.csv: something else lights the module";
  EXPECT_EQ(measured({"capture.csv"}).out.find(words), std::string::npos);
  write("capture.csv", bench_.output + "# pairs of edges lost: 12\n");
  EXPECT_NE(measured({"capture.csv"}).out.find(std::string("left out 12 ") + words),
            std::string::npos);
}

TEST_F(MeasureCommand, FindsThePlanOnTheWireOfTheLed) {
  std::filesystem::remove(path("plan.txt"));
  write("both.csv", bench_.both);
  for (const Words& words : {Words{"both.csv"}, Words{"both.csv", "--drive", "D7"},
                             Words{"both.csv", "--drive", "D7", "--wire", "rx"}}) {
    Words all = words;
    all.emplace_back("--json");
    const auto told = nlohmann::json::parse(measured(all).out);
    EXPECT_EQ(told["captures"][0]["plan"], "the light on D7");
    EXPECT_EQ(told["captures"][0]["wire"], "rx");
    EXPECT_FALSE(told.contains("first_level"));
  }
  const char* levels = "No wire tells how strong light is, so all of it is taken to be as strong";
  EXPECT_NE(measured({"both.csv"}).out.find(levels), std::string::npos);
  expect_refused({"fit", "capture.csv"}, bad_input,
                 "no plan of capture.csv (no plan.txt is beside it, no wire in it drives the LED, "
                 "and no message of 600 Bd is whole in it) say --plan PLAN; of messages --message "
                 "and --baud");
  write("p.txt", bench_.text);
  const std::string planned = measured({"capture.csv", "--plan", "p.txt"}).out;
  EXPECT_NE(planned.find("by the plan p.txt"), std::string::npos);
  EXPECT_EQ(planned.find(levels), std::string::npos);
}

/// What the module made of messages, in light of so much of Emin.
std::string recorded_messages(const channel::ModuleData& module, double over_emin) {
  sim::Plan plan;
  const auto bits = protocol::line_bits(protocol::cosys_encode("IND 011111 OK"));
  for (int k = 0; k < 8; ++k)
    for (std::size_t i = 0; i < bits.size(); ++i) {
      if (bits[i]) continue;
      const double start_ms = 20 + 600.0 * k + static_cast<double>(i) / 0.6;
      if (i > 0 && !bits[i - 1])
        plan.steps.back().cycles_on = static_cast<std::uint64_t>(
            std::lround(59 * (start_ms + 1 / 0.6 - plan.steps.back().start_ms)));
      else
        plan.steps.push_back({start_ms, 59e3, 98, 0, 1, 0});
    }
  return sim::capture_of(
      {{"rx", true, sim::changes_of_output(plan, module, over_emin * module.emin_mw_per_m2)}});
}

// It has neither a plan nor the LED's wire, and still tells a little.
TEST_F(MeasureCommand, TakesARecordingOfMessages) {
  std::filesystem::remove(path("plan.txt"));
  bench_.module.agc_attack_db_per_ms = 0.3;
  write("far.csv", recorded_messages(bench_.module, 180));
  const Outcome o = measured({"far.csv", "--message", "IND 011111 OK"});
  for (const char* words : {"Read rx of far.csv, by the message IND 011111 OK at 600 Bd, 8 times, ",
                            "messages tell little: show it a plan of light"})
    EXPECT_NE(o.out.find(words), std::string::npos) << words << o.out;
  EXPECT_EQ(program({"fit", "far.csv", "--message", "two\nlines"}).code, bad_input);
  const auto attack = number_in(measured({"far.csv", "--message", "IND 011111 OK", "--json"}),
                                "agc_attack_db_per_ms");
  EXPECT_LE(attack.at("low"), 0.3);
  EXPECT_GE(attack.at("high"), 0.3);
}

// Where all bits are reported, few gain controls are shut out, and none is told.
TEST_F(MeasureCommand, TellsNoGainControlOfAPartThatHasNone) {
  std::filesystem::remove(path("plan.txt"));
  bench_.module.agc_attack_db_per_ms = 0;
  write("far.csv", recorded_messages(bench_.module, 5));
  const Outcome o = measured({"far.csv", "--message", "IND 011111 OK", "--json"});
  for (const char* key : {"agc_attack_db_per_ms", "agc_max_duty", "agc_hold_ms", "agc_margin_db"})
    EXPECT_FALSE(number_in(o, key).at("is_told")) << key;
}

TEST_F(MeasureCommand, ReadsAChangeFileAsItReadsRows) {
  write("capture.vcd", as_vcd(bench_.output));
  const auto rows = nlohmann::json::parse(measured({"capture.csv", "--json"}).out).at("steps");
  const auto changes = nlohmann::json::parse(measured({"capture.vcd", "--json"}).out).at("steps");
  ASSERT_EQ(changes.size(), rows.size());
  EXPECT_GE(rows.size(), few_steps);
  for (std::size_t i = 0; i < rows.size(); ++i)
    EXPECT_NEAR(changes[i].at("recorded"), rows[i].at("recorded").get<double>(), 1e-6) << i;
}

// A wire that mirrors the light tells nothing of a module, and a part would have no number of it.
TEST_F(MeasureCommand, RefusesTheWireOfTheLed) {
  write("both.csv", bench_.both);
  expect_refused({"fit", "both.csv", "--wire", "D7", "-o", "mine.toml"}, bad_input,
                 "the recording has every burst as long as its light, however weak (it is the wire "
                 "of the LED, or another copy of the light) say --wire, the module's output");
}

TEST_F(MeasureCommand, WritesNoPartOfWhichNothingIsTold) {
  std::filesystem::remove(path("plan.txt"));
  bench_.module.agc_attack_db_per_ms = 0;
  write("far.csv", recorded_messages(bench_.module, 5));
  const Outcome o = measured({"far.csv", "--message", "IND 011111 OK", "-o", "mine.toml"});
  EXPECT_EQ(o.code, 4);
  EXPECT_NE(o.out.find("\nIn all, "), std::string::npos) << "of no rule";
  EXPECT_TRUE(o.out.ends_with("No part is written, as it would have no number of its own.\n"));
  EXPECT_FALSE(std::filesystem::exists(path("mine.toml")));
}

TEST_F(MeasureCommand, RefusesAPlanInTheCapturesPlace) {
  expect_refused({"fit", "plan.txt"}, bad_input,
                 "plan.txt (it is a plan, not a recording) write cosys-sim fit CAPTURE --plan "
                 "plan.txt");
}

TEST_F(MeasureCommand, RefusesACaptureThatIsNamedTwice) {
  expect_refused({"fit", "capture.csv", "./capture.csv"}, bad_input,
                 "./capture.csv (it is named twice) name each capture once");
}

TEST_F(MeasureCommand, RefusesALightThatIsNone) {
  write("plan.txt",
        std::regex_replace(bench_.text, std::regex("first level: [0-9.]+"), "first level: nan"));
  expect_refused({"fit", "capture.csv"}, bad_input,
                 "first level: nan in plan.txt (it is no irradiance) give mW/m2 above 0, or delete "
                 "the line");
}

TEST_F(MeasureCommand, TakesSeveralCaptures) {
  std::filesystem::create_directory(path("near"));
  write("near/capture.csv", bench_.output);
  write("near/plan.txt", bench_.text);
  const Words both{"capture.csv", "near/capture.csv", "--json"};
  const auto of = [&](const Words& more) {
    Words words = both;
    words.insert(words.end(), more.begin(), more.end());
    return nlohmann::json::parse(measured(words).out)["captures"];
  };
  const auto found = of({});
  EXPECT_EQ(found[1]["file"], "near/capture.csv");
  EXPECT_EQ(found[1]["plan"], "the plan near/plan.txt");
  EXPECT_NEAR(found[1]["level_db"].get<double>(), 0, 0.5);
  EXPECT_EQ(of({"--plan", "plan.txt", "--ambient", "0,10"})[1]["ambient_w_per_m2"], 10);
  EXPECT_EQ(of({"--plan", "plan.txt", "--plan", "near/plan.txt"})[1]["plan"], found[1]["plan"]);
  EXPECT_NE(measured({"capture.csv", "near/capture.csv", "--irradiance", "60,61"})
                .out.find("dB stronger than that of capture.csv.\n"),
            std::string::npos);
}

TEST_F(MeasureCommand, RefusesListsThatAreNotOneForEachCapture) {
  const auto refused = [&](Words more, const std::string& why) {
    more.insert(more.begin(), {"fit", "capture.csv", "capture.csv", "capture.csv"});
    expect_refused(more, bad_input, why);
  };
  refused({"--ambient", "0,1"},
          "--ambient: 2 numbers for 3 captures (each capture has one of its own) name 3");
  refused(
      {"--ambient", "1,1,1"},
      "--ambient (the first capture is under a lamp, too) name one without a lamp first, with 0");
  refused({"--irradiance", "1,2"},
          "--irradiance: 2 numbers for 3 captures (each capture has one of its own, or all one) "
          "name 3, or one");
  refused({"--plan", "plan.txt", "--plan", "plan.txt"},
          "--plan: 2 plans for 3 captures (each capture has one of its own, or all one) name 3, or "
          "one");
  expect_refused({"fit", "capture.csv", "-"}, bad_input,
                 "- (one of several captures cannot be standard input) save it to a file");
}

TEST_F(MeasureCommand, DrawsAPage) {
  const Outcome o = measured({"capture.csv", "--page", "mine.html"});
  EXPECT_NE(o.out.find("Next: write the part with -o modules/mine.toml\n"), std::string::npos);
  EXPECT_TRUE(content(path("mine.html")).starts_with("<!DOCTYPE html>"));
}

TEST_F(MeasureCommand, ReplacesItsOwnFilesAndNoOthers) {
  std::filesystem::create_directory(path("modules"));
  const Words words{"fit", "capture.csv", "-o", "modules/mine.toml", "--page", "mine.html"};
  for (int i = 0; i < 2; ++i) EXPECT_NE(program(words).code, bad_input);
  for (const auto& [file, why] : {std::pair{"modules/mine.toml", "a part of cosys-sim fit"},
                                  {"mine.html", "a report of cosys-sim"}}) {
    const std::string before = content(path(file));
    write(file, "mine\n");
    expect_refused(words, bad_input,
                   std::string("cannot write ") + file + " (it exists and is not " + why +
                       ") choose another name");
    write(file, before);
  }
  expect_refused({"fit", "capture.csv", "-o", "mine.h5"}, bad_input,
                 "--output mine.h5 (a part's file ends in .toml) name a file, such as "
                 "modules/mine.toml");
  expect_refused({"fit", "capture.csv", "-o", "a.toml", "--page", "./a.toml"}, bad_input,
                 "--page ./a.toml (the part is to be written there) choose another name");
  expect_refused({"fit", "capture.csv", "--page", "mine.toml"}, bad_input,
                 "--page mine.toml (a page is HTML) name a file, such as mine.html");
  expect_refused({"fit", "capture.csv", "-o", "nowhere/mine.toml"}, environment,
                 "cannot write nowhere/mine.toml (its folder does not exist) create the folder or "
                 "choose another");
}

TEST_F(MeasureCommand, RefusesWhatIsNoMeasurement) {
  expect_refused({"fit", "none.csv"}, bad_input, "none.csv (no such file) check the path");
  expect_refused({"fit", "capture.csv", "--plan", "none.txt"}, bad_input,
                 "none.txt (no such file) check the path");
  expect_refused(
      {"fit", "capture.csv", "--plan"}, bad_input,
      "--plan with a capture (it names no plan) write --plan PLAN, or leave it out where "
      "plan.txt is beside the capture");
  expect_refused({"fit", "capture.csv", "--minutes", "2"}, bad_input,
                 "--minutes with a capture (it is for a bench) leave it out");
  expect_refused({"fit", "capture.csv", "--carrier", "38e3"}, bad_input,
                 "--carrier with a plan (the plan says what the light was) leave it out");
  expect_refused({"fit", "capture.csv", "--module", "ideal-coherent"}, bad_input,
                 "ideal-coherent (no module that can be bought) name one that is like yours");
  expect_refused({"fit", "capture.csv", "--wire", "D3"}, bad_input,
                 "--wire D3 is not in capture.csv (the capture has no such wire) use rx");
  expect_refused({"fit", "capture.csv", "--wire", "rx", "--drive", "rx"}, bad_input,
                 "--drive rx (it is the module's output) name the wire that drives the LED");
  write("light.csv",
        sim::capture_of({{"out", false, sim::changes_of_carrier({{{10, 56e3, 100, 900, 9, 0}}})}}));
  expect_refused({"fit", "light.csv"}, bad_input,
                 "out of light.csv (it has a carrier of 56 kHz, which a module's output has not) "
                 "say --wire, the module's output");
  write("still.csv", "time_s,rx\n0,1\n1,1\n");
  expect_refused({"fit", "still.csv"}, bad_input,
                 "rx of still.csv (it never changes: the module reported nothing, or is not "
                 "connected) look at wires and supply, or say --wire");
}

}  // namespace
