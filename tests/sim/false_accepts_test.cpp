// A receiver that listens for hours: what it accepts that nobody sent it.
#include "sim/false_accepts/false_accepts.hpp"
#include "sim/columns/columns_dataset.hpp"
#include "sim/columns/columns_table.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <variant>
#include <vector>

#include "counted_points.hpp"
#include "gtest/gtest.h"
#include "held_intervals.hpp"
#include "program.hpp"
#include "protocol/shared_link.hpp"
#include "sim/check/false_accept_comparison.hpp"
#include "sim/command/experiments.hpp"
#include "sim/false_accepts/false_accept_report.hpp"
#include "tests/sim/scenarios.hpp"

namespace sim {
namespace {

const std::string silence = R"(
experiment = "listening"
[receiver]
module = "TSSP4056"
[listening]
duration_s = 20
runs = 6
)";

constexpr Workers two{.threads = 2, .interrupt = nullptr};

Scenario scene(const std::vector<std::string>& set) {
  return point_scenario(loaded(silence, set), {});
}

FalseAcceptPoint only_point(const std::vector<std::string>& set) {
  const auto points = counted_points(false_accept_measurement, loaded(silence, set), two);
  EXPECT_EQ(points.size(), 1U);
  return points.front();
}

std::vector<protocol::UartByte> read(const FalseAcceptSetup& at, const dsp::LogicTrace& wire) {
  return at.link.uart->receive(wire, at.link.device_baud, 0);
}

/// COSYS messages of a wire that is no receiver's.
std::uint64_t messages_on(const FalseAcceptSetup& at, const dsp::LogicTrace& wire) {
  protocol::CosysDecoder decoder;
  std::uint64_t n = 0;
  for (const protocol::UartByte& byte : read(at, wire)) {
    const auto frame = decoder.push(byte);
    n += frame && frame->outcome == protocol::CosysOutcome::ok;
  }
  return n;
}

// ---- a device that is dark ----

TEST(FalseAcceptSetup, ADarkDeviceSendsNothingAndLosesNothing) {
  const FalseAcceptPoint point = only_point({});
  EXPECT_EQ(point.tally, (FalseAcceptTally{.n_runs = 6}));
  EXPECT_DOUBLE_EQ(point.hours, 6 * 20 / 3600.0);
  EXPECT_TRUE(std::isnan(point.undetected_per_hour().value)) << "nothing was sent";
  EXPECT_EQ(point.false_per_hour().value, 0);
  EXPECT_EQ(point.false_per_hour().low, 0);
  EXPECT_NEAR(point.false_per_hour().high, 3.6889 / point.hours, 1e-3 / point.hours);
}

// Another device, bright and alone, is accepted message for message: those of its own wire.
TEST(FalseAcceptSetup, CountsEachMessageOfAKnownSender) {
  const FalseAcceptSetup at = make_false_accepts(scene({"listening.air=cosys"}));
  std::uint64_t sent = 0;
  for (std::uint32_t run = 0; run < 6; ++run) {
    const Transmission nothing = line_of(at, run);
    EXPECT_TRUE(nothing.messages.empty());
    EXPECT_TRUE(nothing.line.edges().empty());
    EXPECT_EQ(nothing.line.end(), at.duration);
    auto drive = chain_input(at.link, run, nothing).disturbances.at(0).drive;
    sent += messages_on(at, drive);
  }
  // 283 ms and 500 ms of pause: 153 in 120 s, less those that a run's ends cut.
  EXPECT_NEAR(static_cast<double>(sent), 120 / 0.783, 12);
  const FalseAcceptPoint point = only_point({"listening.air=cosys"});
  EXPECT_NEAR(static_cast<double>(point.tally.n_frames_false), static_cast<double>(sent), 6)
      << "but for the last of a run, which may be late";
  EXPECT_DOUBLE_EQ(point.false_per_hour().value,
                   static_cast<double>(point.tally.n_frames_false) / point.hours);
}

// ---- SharedLink in the air ----

TEST(FalseAcceptSetup, SharedLinkArrivesAsSharedLinkAndIsNoMessageOfADevice) {
  const FalseAcceptSetup at = make_false_accepts(scene({"listening.air=sharedlink"}));
  const HeardTrials heard = hear_runs(at, 0, 6);
  int ok = 0, refused = 0;
  for (const dsp::LogicTrace& pin : heard.pins) {
    protocol::SharedLinkDecoder decoder;
    for (const protocol::UartByte& byte : read(at, pin))
      if (const auto frame = decoder.push(byte))
        ++(frame->outcome == protocol::SharedLinkOutcome::ok ? ok : refused);
  }
  EXPECT_GT(ok, 60) << "0.8 s of message and 0.5 s of pause: 90 in 120 s";
  EXPECT_EQ(refused, 0);
  const FalseAcceptTally tally = only_point({"listening.air=sharedlink"}).tally;
  EXPECT_EQ(tally.n_frames_false, 0U);
  EXPECT_NEAR(static_cast<double>(tally.n_rejected), ok, 6) << "its line feed ends a line";
}

// ---- a device that sends ----

TEST(FalseAcceptSetup, OfADeviceNearByAllIsDeliveredAndNothingElse) {
  const FalseAcceptTally tally = only_point({"listening.device_sends=true"}).tally;
  EXPECT_GT(tally.n_frames, 130U);
  EXPECT_EQ(tally.n_frames_ok, tally.n_frames);
  EXPECT_EQ(tally.n_frames_undetected + tally.n_frames_false + tally.n_rejected, 0U);
  EXPECT_EQ(tally.n_characters, tally.n_frames * 17);
}

TEST(FalseAcceptSetup, ARunHasRoomForAllThatItSends) {
  const FalseAcceptSetup at = make_false_accepts(
      scene({"listening.device_sends=true", "device.start_jitter_us=2000", "listening.runs=1"}));
  for (std::uint32_t run = 0; run < 50; ++run) {
    const Transmission sent = line_of(at, run);
    EXPECT_EQ(sent.line.end(), at.duration);
    for (std::size_t i = 1; i < sent.messages.size(); ++i)
      EXPECT_GE(sent.messages[i].byte_start[0] - sent.messages[i - 1].end,
                dsp::Seconds(0.1 - 1e-9));
    EXPECT_LT(sent.messages.back().end, at.duration);
    EXPECT_GT(sent.messages.back().end, at.duration - dsp::Seconds(2));
  }
}

// Of a device that cannot be heard a neighbour's messages are all that is accepted: while it sends
// they are undetected errors, else false accepts.
TEST(FalseAcceptSetup, WhatIsAcceptedIsAnErrorWhileTheDeviceSends) {
  const std::vector<std::string> set{"listening.air=cosys", "listening.device_sends=true",
                                     "receiver.range_m=100"};
  const FalseAcceptTally both = only_point(set).tally;
  EXPECT_EQ(both.n_frames_ok, 0U);
  EXPECT_GT(both.n_frames_undetected, 40U) << "0.57 of the neighbour's messages overlap one";
  EXPECT_GT(both.n_frames_false, 5U);
  EXPECT_NEAR(static_cast<double>(both.n_frames_undetected + both.n_frames_false), 120 / 0.783, 14);
}

// ---- results ----

TEST(FalseAcceptSetup, IsTheSameForAnyNumberOfThreads) {
  const LoadedScenario s =
      loaded(silence, {"listening.air=cosys", "listening.device_sends=true",
                       "listening.duration_s=5", "listening.runs=20", "receiver.range_m=11"});
  const std::string one = dataset_digest(
      dataset_of(s, "", false_accept_columns(), counted_points(false_accept_measurement, s, {1})));
  EXPECT_EQ(dataset_digest(dataset_of(s, "", false_accept_columns(),
                                      counted_points(false_accept_measurement, s, {3}))),
            one);
}

const Dataset::Variable& variable(const Dataset& data, const std::string& name) {
  const auto at = std::ranges::find(data.variables, name,
                                    [](const Dataset::Variable& v) { return v.facts.name; });
  EXPECT_NE(at, data.variables.end()) << name;
  return *at;
}

TEST(FalseAcceptSetup, ItsVariablesHaveUnitsAndNoFrameLossOfADarkDevice) {
  const LoadedScenario s = loaded(silence, {"listening.runs=1", "listening.device_sends=0,1"});
  const Dataset data =
      dataset_of(s, "", false_accept_columns(), counted_points(false_accept_measurement, s, two));
  EXPECT_EQ(variable(data, "line_h").facts.unit, "h");
  for (const std::string name : {"false_per_hour", "undetected_per_hour"})
    for (const std::string suffix : {"", "_ci_low", "_ci_high"})
      EXPECT_EQ(variable(data, name + suffix).facts.unit, "1/h");
  const auto& rate = std::get<std::vector<double>>(variable(data, "undetected_per_hour").values);
  EXPECT_TRUE(std::isnan(rate.at(0))) << "dark";
  EXPECT_EQ(rate.at(1), 0);
  for (const Dataset::Variable& v : data.variables) {
    EXPECT_FALSE(v.facts.long_name.empty()) << v.facts.name;
    EXPECT_FALSE(v.facts.name.starts_with("flr")) << "nothing was sent";
  }
  const auto json = nlohmann::json::parse(dataset_json(data));
  EXPECT_TRUE(json["variables"]["undetected_per_hour_ci_high"]["values"][0].is_null());
}

TEST(FalseAcceptSetup, TheTableSpeaksOfWhatIsSentOnlyWhereTheDeviceMaySend) {
  const LoadedScenario dark = loaded(silence),
                       either = loaded(silence, {"listening.device_sends=0,1"});
  const auto head = [](const LoadedScenario& scenario) {
    return PointTable(false_accept_columns(), scenario, FalseAcceptPoint{}).head();
  };
  EXPECT_EQ(head(dark).find("undetected"), std::string::npos);
  EXPECT_NE(head(either).find("undetected"), std::string::npos);
  EXPECT_NE(head(dark).find("[1/h]"), std::string::npos);
  const FalseAcceptPoint point{.coordinates = {}, .hours = 2, .tally = {.n_runs = 120}};
  EXPECT_NE(PointTable(false_accept_columns(), dark, point).row(point).find(" < 1.9 "),
            std::string::npos)
      << PointTable(false_accept_columns(), dark, point).row(point);
  const FalseAcceptPoint busy{
      .coordinates = {},
      .hours = 1,
      .tally = {.n_runs = 60, .n_frames_false = 4500, .false_squared = 60 * (75 * 75 + 1)}};
  EXPECT_NE(PointTable(false_accept_columns(), dark, busy).row(busy).find(" 4500 [4484, 4516]"),
            std::string::npos)
      << PointTable(false_accept_columns(), dark, busy).row(busy);
}

std::string refused(const std::vector<std::string>& set) {
  try {
    check_experiment(loaded(silence, set));
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::bad_input);
    return failure.what();
  }
  return "accepted";
}

TEST(FalseAcceptSetup, RefusesWhatItCannotHear) {
  EXPECT_EQ(
      refused({"receiver.module=ideal-coherent"}),
      "receiver.module = \"ideal-coherent\" in --set (an ideal receiver is told when bits are "
      "sent, and by one sender only) use a module");
  EXPECT_EQ(
      refused({"listening.air=none,cosys", "device.carrier_hz=38e3", "module.centre_hz=38e3",
               "simulation.sample_rate_hz=200e3"}),
      "listening.air = \"cosys\" in --set with simulation.sample_rate_hz = 200000 in --set (a "
      "carrier period takes at least 4 samples) raise simulation.sample_rate_hz to 236000");
  EXPECT_EQ(refused({"stop.max_frames=8"}),
            "stop.max_frames in --set (it means nothing in the experiment \"listening\") set "
            "listening.runs, or stop.rel_ci to end at a width of the interval");
  EXPECT_EQ(refused({"listening.air=*"}), "accepted");
}

// ---- decoders on the same line ----

/// Hears what another does, and its device so many times more in each run; or nothing at all.
class Dreamer : public Decoder {
 public:
  explicit Dreamer(int words) : words_(words) {}
  const std::string& name() const override { return name_; }
  Decoded decode(const DelimitedStream& line) const override {
    Decoded decoded;
    if (words_ < 0) return decoded;
    decoded = decoder_->decode(line);
    decoded.accepted.insert(decoded.accepted.begin() + 1, static_cast<std::size_t>(words_),
                            "IND 011111 OK");
    return decoded;
  }

 private:
  int words_;
  std::string name_ = "dreamer";
  std::unique_ptr<Decoder> decoder_ = make_built_in_decoder("atmega");
};

TEST(FalseAcceptComparison, CountsAllThatADecoderAcceptsOfADarkDevice) {
  const auto atmega = make_built_in_decoder("atmega");
  const Dreamer twice(2), deaf(-1);
  const auto point =
      false_accept_comparison(loaded(silence), 0, {atmega.get(), &twice, &deaf}, two);
  EXPECT_EQ(point.accepts[0].n_runs, 6U);
  EXPECT_EQ(point.accepts[0].n_wrong, 0U);
  EXPECT_EQ(point.accepts[1].n_wrong, 12U);
  EXPECT_DOUBLE_EQ(point.wrong_per_hour(1).value, 12 / (120 / 3600.0));
  EXPECT_TRUE(point.accepts[2].fault.has_value());
  EXPECT_TRUE(std::isnan(point.wrong_per_hour(2).value));
  const Decoders all{atmega.get(), &twice, &deaf};
  EXPECT_NE(false_accept_comparison_text({point}, all)
                .find("dreamer failed at x: it lost an undisturbed"),
            std::string::npos);
  const auto json = nlohmann::json::parse(false_accept_comparison_json({point}, all));
  EXPECT_EQ(json["points"][0]["decoders"][1]["n_accepted_wrong"], 12);
  EXPECT_TRUE(json["points"][0]["decoders"][2]["wrong_per_hour"].is_null());
}

// What `run` counts of the line, a decoder does too that is given it between markers.
TEST(FalseAcceptComparison, AgreesWithRun) {
  const std::vector<std::string> sends{"listening.device_sends=true"},
      neighbour{"listening.air=cosys"};
  const auto atmega = make_built_in_decoder("atmega"), soft = make_built_in_decoder("soft");
  const Decoders both{atmega.get(), soft.get()};
  const auto delivered = false_accept_comparison(loaded(silence, sends), 0, both, two);
  const auto accepted = false_accept_comparison(loaded(silence, neighbour), 0, both, two);
  for (std::size_t d = 0; d < 2; ++d) {
    EXPECT_EQ(delivered.accepts[d].n_ok, only_point(sends).tally.n_frames_ok);
    EXPECT_EQ(delivered.accepts[d].n_wrong, 0U);
    EXPECT_NEAR(static_cast<double>(accepted.accepts[d].n_wrong),
                static_cast<double>(only_point(neighbour).tally.n_frames_false), 6);
    EXPECT_EQ(accepted.accepts[d].n_ok, 0U);
  }
}

// A neighbour comes in a rhythm: accepts scatter less than by chance. Of its messages, 283 ms with
// 0.1 to 0.9 s between, a run has room for those that begin and end in it.
TEST(HeldIntervals, MeasuredOfANeighboursAccepts) {
  const FalseAcceptSetup at = make_false_accepts(scene({"listening.air=cosys"}));
  constexpr std::uint32_t runs = 6;
  const auto experiment = [&](std::uint64_t seed) {
    FalseAcceptPoint point{.coordinates = {}, .hours = hours_of(at, runs)};
    point.tally = run_false_accepts(at, static_cast<std::uint32_t>(seed) * runs, runs);
    const Estimate rate = point.false_per_hour();
    return held::Printed{rate.low, rate.high, 3600 * (20 - 0.2833) / 0.7833 / 20};
  };
  held::expect_to_hold({"false accepts an hour", "6 runs of 20 s, a neighbour in the air", 5},
                       experiment);
}

// ---- commands ----

class FalseAcceptCommand : public CommandLine {};

TEST_F(FalseAcceptCommand, RunAndCompareSayWhatIsAcceptedAnHour) {
  write("quiet.toml", silence);
  const Outcome table = program({"run", "quiet.toml", "-q"});
  EXPECT_EQ(table.code, 0) << table.err;
  EXPECT_NE(table.out.find("< 111"), std::string::npos) << "3.689 / (1/30 h)\n" << table.out;
  const auto run = nlohmann::json::parse(program({"run", "quiet.toml", "-q", "--json"}).out);
  EXPECT_NEAR(run["variables"]["false_per_hour_ci_high"]["values"][0], 110.67, 0.01);
  const Outcome compared = program(
      {"compare", "quiet.toml", "-q", "--json", "--decoder", "atmega", "--decoder", "soft"});
  EXPECT_EQ(compared.code, 0) << compared.err;
  const auto comparison = nlohmann::json::parse(compared.out);
  for (const auto& decoder : comparison["points"][0]["decoders"])
    EXPECT_NEAR(decoder["wrong_per_hour_ci_high"], 110.67, 0.01) << decoder;
}

TEST_F(FalseAcceptCommand, CompareFailsWhereADecoderDoes) {
  write("quiet.toml", silence);
  const Outcome o = program({"compare", "quiet.toml", "-q", "--decoder", "exit 7"});
  EXPECT_EQ(o.code, 1);
  EXPECT_NE(o.out.find("exit 7 failed at quiet: exit code 7"), std::string::npos) << o.out;
}

TEST_F(FalseAcceptCommand, CompareTakesNoLinksBesides) {
  write("quiet.toml", silence);
  write("link.toml", "");
  const Outcome o = program({"compare", "link.toml", "quiet.toml", "-q"});
  EXPECT_EQ(o.code, 2);
  EXPECT_NE(o.err.find("quiet.toml (it listens, and not all others do) compare on it in a command "
                       "of its own"),
            std::string::npos)
      << o.err;
}

}  // namespace
}  // namespace sim
