// trace, encode and decode from outside, with sigrok's UART decoder as a judge of our captures.
#include <cmath>
#include <nlohmann/json.hpp>

#include "program.hpp"

namespace {

const std::string on_the_wire = "IND 011111 OK 46\n";
const std::string far_and_near = "receiver.range_m = [900, 0.5]";

/// The second point of the sweep, where everything arrives.
Words trace_to(const std::string& file) { return {"trace", "s.toml", "--point", "1", "-o", file}; }

/// The time at which a VCD of 1 us ends: its last line.
double end_of_vcd_s(const std::string& trace) {
  return std::stod(trace.substr(trace.rfind('#') + 1)) * 1e-6;
}

TEST_F(CommandLine, EncodePrintsWhatTheLineCarries) {
  const Outcome o = program({"encode", "IND 011111 OK"});
  EXPECT_EQ(o.code, 0);
  EXPECT_EQ(o.out, on_the_wire);
  EXPECT_EQ(o.err, "");
}

TEST_F(CommandLine, SigrokReadsBothWiresOfATrace) {
  write_scenario("s.toml", far_and_near);
  const Outcome o = program(trace_to("t.vcd"));
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(o.out + o.err, "");
  for (const char* wire : {"rx", "tx"}) {
    const std::string uart = std::string("uart:rx=") + wire + ":baudrate=600";
    EXPECT_EQ(tool("sigrok-cli", {"-i", "t.vcd", "-P", uart, "-B", "uart=rx"}), on_the_wire);
  }
  EXPECT_EQ(files(), (std::set<std::string>{"s.toml", "t.vcd"}));
}

TEST_F(CommandLine, DecodeReadsWhatTraceWrites) {
  write_scenario("s.toml", far_and_near);
  ASSERT_EQ(program(trace_to("t.vcd")).code, 0);
  const auto start_s = [&](const char* wire, const char* uart) {
    const Outcome o = program({"decode", "t.vcd", "--wire", wire, "--uart", uart, "--json"});
    const auto json = nlohmann::json::parse(o.out.substr(0, o.out.find('\n')));
    EXPECT_EQ(json.at("outcome"), "ok");
    EXPECT_EQ(json.at("message"), "IND 011111 OK");
    return json.at("time_s").get<double>();
  };
  const double sent = start_s("tx", "mid-bit"), heard = start_s("rx", "mid-bit");
  EXPECT_GT(sent, 20e-3);             // dark before the first message
  EXPECT_GT(heard - sent, 5 / 59e3);  // a module takes some cycles of the carrier to see it
  EXPECT_LT(heard - sent, 0.5 / 600);
  EXPECT_NEAR(start_s("rx", "atmega"), heard, 2.0 / 16 / 600);  // it samples 16 times a bit
  const std::string line = program({"decode", "t.vcd"}).out;
  EXPECT_NE(line.find(" s  ok              IND 011111 OK\n"), std::string::npos) << line;
}

TEST_F(CommandLine, DecodeRefusesWhatItCannotRead) {
  write_scenario("s.toml", far_and_near);
  write("garbage.vcd", "garbage\n");
  ASSERT_EQ(program(trace_to("t.vcd")).code, 0);
  expect_refused({"decode", "missing.vcd"}, bad_input, "missing.vcd (no such file) check the path");
  expect_refused(
      {"decode", "s.toml"}, bad_input,
      "cannot decode s.toml (neither its ending nor its first bytes name a capture "
      "format) give a .vcd or .sr or .ook or .wav or .sigmf-meta or .sigmf-data or .csv or .h5 or "
      ".bin file, or say --format");
  for (const char* baud : {"nan", "inf", "0", "1e7", "x", ""})
    EXPECT_EQ(program({"decode", "t.vcd", "--baud", baud}).code, bad_input) << baud;
  expect_refused({"decode", "t.vcd", "--wire", "tr"}, bad_input,
                 "--wire tr is not in t.vcd (the capture has no such wire) use tx or rx");
  const Outcome o = program({"decode", "garbage.vcd"});
  EXPECT_EQ(o.code, bad_input);
  EXPECT_EQ(std::ranges::count(o.err, '\n'), 1) << o.err;
}

// Decisions make no samples: there are wires to trace, but no taps.
TEST_F(CommandLine, TraceOfDecisionsHasTheWires) {
  write_scenario("s.toml", "receiver.ebn0_db = [20, 40]");
  const auto trace = [](const char* file) {
    return Words{"trace", "s.toml",
                 "-o",    file,
                 "--set", "simulation.fidelity=decision",
                 "--set", "receiver.module=ideal-coherent"};
  };
  ASSERT_EQ(program(trace("t.vcd")).code, 0);
  const std::string line = program({"decode", "t.vcd"}).out;
  EXPECT_NE(line.find(" s  ok              IND 011111 OK\n"), std::string::npos) << line;
  ASSERT_EQ(program(trace("t.bin")).code, 0);
  for (const char* file : {"t.csv", "t.h5", "t.wav", "t.sigmf-meta"})
    expect_refused(trace(file), bad_input,
                   std::string("cannot trace into ") + file +
                       " (no samples are made at simulation.fidelity = \"decision\") end the name "
                       "in .vcd, which has the wires");
}

TEST_F(CommandLine, CsvHasARowASample) {
  write_scenario("s.toml", far_and_near);
  ASSERT_EQ(program(trace_to("t.csv")).code, 0);
  ASSERT_EQ(program(trace_to("t.vcd")).code, 0);
  const std::string csv = content(path("t.csv"));
  EXPECT_TRUE(
      csv.starts_with("time_s,tx,irradiance_mw_per_m2,band_pass_mw_per_m2,threshold_mw_per_m2,"
                      "integrator_samples,agc_gain,rx\n0.000004000,1,"))
      << csv.substr(0, 200);
  const double samples = end_of_vcd_s(content(path("t.vcd"))) * 250e3;
  EXPECT_NEAR(static_cast<double>(std::ranges::count(csv, '\n') - 1), std::ceil(samples), 1);
  EXPECT_GT(samples, 17 * 10 * 250e3 / 600);  // the message alone
}

TEST_F(CommandLine, Hdf5TraceSaysWhereItComesFrom) {
  write_scenario("s.toml", far_and_near);
  Words words = trace_to("t.h5");
  words.insert(words.end(), {"--trial", "5", "--seed", "7"});
  ASSERT_EQ(program(words).code, 0);
  const std::string header = tool("ncdump", {"-h", "t.h5"});
  for (const char* attribute :
       {":filetype = \"cosys-sim trace\" ;", ":seed = 7ULL ;", ":point = 1ULL ;", ":trial = 5ULL ;",
        ":sample_rate_hz = 250000. ;", ":program = \"cosys-sim\" ;"})
    EXPECT_NE(header.find(attribute), std::string::npos) << attribute << " in " << header;
}

TEST_F(CommandLine, TrialsDifferAndRepeat) {
  write_scenario("s.toml", far_and_near);
  const auto traced = [&](const char* trial) {
    EXPECT_EQ(program({"trace", "s.toml", "--trial", trial, "-o", "t.csv"}).code, 0);
    return content(path("t.csv"));
  };
  const std::string fifth = traced("5");
  EXPECT_TRUE(traced("6") != fifth);
  EXPECT_TRUE(traced("5") == fifth);
}

TEST_F(CommandLine, TraceRefusesPointsAndTrialsOutOfRange) {
  write_scenario("s.toml", far_and_near);
  const auto trace = [](const char* option, const char* value) {
    return Words{"trace", "s.toml", "-o", "t.vcd", option, value};
  };
  expect_refused(trace("--point", "2"), bad_input,
                 "--point 2 (the sweep has 2 points, counted from 0) use one from 0 to 1");
  const std::string see = " (wrong usage) see cosys-sim trace --help";
  expect_refused(trace("--point", "-1"), bad_input,
                 "--point: -1 is not a whole number, counted from 0" + see);
  expect_refused(trace("--trial", "1.5"), bad_input,
                 "--trial: 1.5 is not a whole number, counted from 0" + see);
  expect_refused(trace("--trial", "5000000000"), bad_input,
                 "--trial: 5000000000 is no number from 0 to 4294967295" + see);
  expect_refused({"trace", "s.toml"}, bad_input, "--output is required" + see);
}

}  // namespace
