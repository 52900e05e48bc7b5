// Other lights as a scenario names them: their keys and checks, their draws, and what they do to
// the link.
#include "sim/link/disturbance.hpp"

#include <algorithm>
#include <set>

#include "gtest/gtest.h"
#include "program.hpp"
#include "protocol/cosys.hpp"
#include "protocol/shared_link.hpp"
#include "protocol/uart_receivers.hpp"
#include "scenarios.hpp"
#include "sim/scenario/canonical_text.hpp"
#include "sim/scenario/disturbance_keys.hpp"
#include "sim/trial/trial.hpp"

namespace sim {
namespace {

// ---- keys ----

TEST(DisturbanceKeys, AnyNumberOfThemEachWithTheDefaultsOfItsKind) {
  const Scenario s =
      loaded(
          "[disturbance.desk-lamp_2]\nkind = \"fluorescent\"\nballast_hz = 41e3\n"
          "[disturbance.tv]\nkind = \"remote\"\n",
          {"disturbance.b.kind=cosys", "disturbance.b.message=x", "disturbance.tv.carrier_hz=36e3"})
          .base;
  ASSERT_EQ(s.disturbances.size(), 3u);
  EXPECT_EQ(s.disturbances.at("desk-lamp_2").ballast_hz, 41e3);
  EXPECT_EQ(s.disturbances.at("desk-lamp_2").irradiance_w_per_m2, 0.03);
  EXPECT_EQ(s.disturbances.at("tv").carrier_hz, 36e3);
  EXPECT_EQ(s.disturbances.at("tv").bursts, 33);
  EXPECT_EQ(s.disturbances.at("b").message, "x");
  EXPECT_EQ(s.disturbances.at("b").carrier_hz, 59e3);
}

TEST(DisturbanceKeys, EveryNumberOfEveryKindIsSetSweptAndPhysics) {
  for (const DisturbanceKind& kind : disturbance_kinds()) {
    const std::string with_kind = "disturbance.a.kind=" + kind.name;
    const std::string standard = canonical_text(loaded("", {with_kind}).base);
    for (const DisturbanceNumber& number : kind.numbers) {
      const bool whole = number.facts.type == KeyType::whole_number;
      const double other = whole ? number.standard - 1 : number.standard * 0.984375;
      const std::string key = "disturbance.a." + number.facts.name;
      const std::string set = key + "=" + std::to_string(other) + ",";
      const auto swept = loaded("", {with_kind, set + std::to_string(number.standard)});
      const Scenario s = point_scenario(swept, {swept.sweep.at(0).values.at(0)});
      EXPECT_NEAR(s.disturbances.at("a").*number.member, other, 1e-6) << key;
      EXPECT_NE(canonical_text(s), standard) << key;
      EXPECT_TRUE(number.facts.range.contains(number.standard)) << key;
      EXPECT_EQ(swept.sweep[0].unit, number.facts.unit);
    }
  }
}

TEST(DisturbanceKeys, TheKeptTextRepeatsTheRun) {
  const auto first =
      loaded("[disturbance.a]\nkind = \"pwm\"\n[sweep]\ndisturbance.a.duty = [0.2, 0.5]",
             {"disturbance.b.kind=cosys", "disturbance.b.message=a \"b"});
  const auto again = loaded(first.text);
  EXPECT_EQ(canonical_text(again.base), canonical_text(first.base));
  EXPECT_EQ(again.sweep.at(0).values, first.sweep.at(0).values);
}

std::string kind_list(const std::string& between) {
  std::string list;
  for (const DisturbanceKind& kind : disturbance_kinds())
    list += (list.empty() ? "" : between) + kind.name;
  return list;
}

TEST(DisturbanceKeys, AreRefusedInOneLine) {
  EXPECT_EQ(refusal("[disturbance.a]\nkind = \"lamp\""),
            "disturbance.a.kind = \"lamp\" in x.toml:2 (the kind of another light is one of a "
            "list) use " +
                kind_list(" or "));
  EXPECT_EQ(refusal("[disturbance.a]\nballast_hz = 30e3"),
            "disturbance.a.ballast_hz in x.toml:2 (disturbance.a has no kind) add its kind: " +
                kind_list(", "));
  EXPECT_EQ(
      refusal("", {"disturbance.a.duty=0.2,0.3"}),
      "disturbance.a.duty in --set (disturbance.a has no kind) add its kind: " + kind_list(", "));
  EXPECT_EQ(refusal("[disturbance.a]\nkind = \"carrier\"\nballast_hz = 30e3"),
            "disturbance.a.ballast_hz in x.toml:3 (no such key of kind carrier) it has "
            "irradiance_w_per_m2, carrier_hz, carrier_duty");
  EXPECT_EQ(refusal("[disturbance.a]\nkind = \"pwm\"\nmessage = \"x\""),
            "disturbance.a.message in x.toml:3 (no such key of kind pwm) it has "
            "irradiance_w_per_m2, frequency_hz, duty");
  EXPECT_EQ(refusal("[disturbance.a]\nkind = \"pwm\"\ndutty = 0.3"),
            "disturbance.a.dutty in x.toml:3 (no such key) did you mean disturbance.a.duty?");
  EXPECT_EQ(refusal("[disturbance.\"a b\"]\nkind = \"pwm\""),
            "disturbance.a b.kind in x.toml:2 (no name of a disturbance) use letters, digits, - "
            "and _ for it");
  EXPECT_EQ(refusal("[disturbance.a]"),
            "[disturbance.a] in x.toml:1 (the disturbance has no kind) add its kind or remove the "
            "table");
  EXPECT_EQ(refusal("[sweep]\ndisturbance.a.kind = [\"pwm\", \"ripple\"]"),
            "disturbance.a.kind in x.toml:2 (text cannot be swept) write one scenario for each "
            "text");
  EXPECT_EQ(
      refusal("[disturbance.a]\nkind = \"pwm\"\nduty = 1.5"),
      "disturbance.a.duty = 1.5 in x.toml:3 (lit fraction of a pulse's period must be at most "
      "1) use a value 0.01 to 1");
}

TEST(DisturbanceKeys, ADisturbanceHasAName) {
  EXPECT_EQ(
      refusal("[disturbance]\nkind = \"pwm\""),
      "disturbance.kind in x.toml:2 (a disturbance has a name) write [disturbance.NAME], such "
      "as [disturbance.lamp]");
}

TEST(DisturbanceKeys, ContradictionsAreRefused) {
  EXPECT_EQ(
      refusal("[disturbance]\na.kind = \"carrier\"\na_carrier.kind = \"pwm\"\n[sweep]\n"
              "disturbance.a.carrier_duty = [0.3, 0.5]\ndisturbance.a_carrier.duty = [0.3, 0.5]"),
      "disturbance.a.carrier_duty and disturbance.a_carrier.duty (the result file calls both "
      "disturbance_a_carrier_duty) rename one disturbance");
  EXPECT_EQ(refusal("simulation.sample_rate_hz = 6e5\n[disturbance.a]\nkind = \"carrier\"\n"
                    "carrier_hz = 2e5"),
            "disturbance.a.carrier_hz = 200000 in x.toml:4 with simulation.sample_rate_hz = 600000 "
            "in x.toml:1 (a carrier period takes at least 4 samples) lower "
            "disturbance.a.carrier_hz to 150000 or raise simulation.sample_rate_hz to 800000");
  EXPECT_EQ(refusal("[disturbance.a]\nkind = \"cosys\"\ninterval_min_ms = 1000"),
            "disturbance.a.interval_min_ms = 1000 in x.toml:3 with disturbance.a.interval_max_ms = "
            "900 by default (the shortest pause cannot exceed the longest) lower "
            "disturbance.a.interval_min_ms to 900 or raise disturbance.a.interval_max_ms to 1000");
  EXPECT_EQ(refusal("[disturbance.a]\nkind = \"remote\"\n[sweep]\ndisturbance.a.repetition_ms = "
                    "[108, 80]"),
            "disturbance.a.repetition_ms = 80 in x.toml:4 (a frame may last 87.75 ms) use more "
            "than that");
}

// ---- light ----

// A2 through the scenario; the mean of every disturbance is ambient light.
TEST(Disturbance, AllSteadyLightIsAmbient) {
  EXPECT_DOUBLE_EQ(link_of({"ambient.irradiance_w_per_m2=1", "ambient.tungsten_lux=1400",
                            "ambient.daylight_lux=4100"})
                       .operating.ambient_w_per_m2,
                   16);
  const Link link = link_of({"ambient.irradiance_w_per_m2=1", "disturbance.a.kind=pwm",
                             "disturbance.a.irradiance_w_per_m2=2", "disturbance.b.kind=carrier",
                             "disturbance.b.irradiance_w_per_m2=4"});
  EXPECT_DOUBLE_EQ(link.operating.ambient_w_per_m2, 5);
  EXPECT_EQ(link.chain.noise_dark, link_of({"ambient.irradiance_w_per_m2=5"}).chain.noise_dark);
}

// Vishay 82459 Fig. 6 for tungsten and day; of a fluorescent lamp 2e-5 W/m2 a lux, of LEDs 1e-6.
TEST(Disturbance, LampsAreAsBrightAsTheirLux) {
  const auto ambient = [](const std::string& kind, const std::string& lux) {
    return link_of({"ambient.irradiance_w_per_m2=0", "disturbance.l.kind=" + kind,
                    "disturbance.l.lux=" + lux})
        .operating.ambient_w_per_m2;
  };
  EXPECT_DOUBLE_EQ(ambient("incandescent", "1400"), 10);
  EXPECT_DOUBLE_EQ(ambient("halogen", "1400"), 8.4);
  EXPECT_DOUBLE_EQ(ambient("sun", "8200"), 10);
  EXPECT_DOUBLE_EQ(ambient("fluorescent_magnetic", "500"), 0.01);
  EXPECT_DOUBLE_EQ(ambient("fluorescent_electronic", "500"), 0.01);
  EXPECT_DOUBLE_EQ(ambient("led_panel", "500"), 5e-4);
}

// Of 500 lx the line at twice the ballast's frequency is 0.15 of 10 mW/m2.
TEST(Disturbance, ABallastsLineIsAsDeepAsInTheInfrared) {
  const auto tones = [](const std::vector<std::string>& set) {
    return design_disturbance(loaded("", set).base.disturbances.at("l"), dsp::Hertz(600e3)).tones;
  };
  const auto lamp = tones({"disturbance.l.kind=fluorescent_electronic"});
  const auto second = std::ranges::find(lamp, 2U, &channel::ToneDesign::harmonic);
  ASSERT_NE(second, lamp.end());
  EXPECT_NEAR(second->amplitude, 1.5, 1e-6);
  EXPECT_EQ(tones({"disturbance.l.kind=sun"}).size(), 0U);
}

/// Share of time in which a drive wire is low.
double lit_share(const dsp::LogicTrace& drive, double seconds) {
  int lit = 0;
  constexpr int n = 200000;
  dsp::TraceReader reader(drive);
  for (int i = 0; i < n; ++i) lit += !reader.level_at(dsp::Seconds(seconds * i / n));
  return double{1} * lit / n;
}

TEST(Disturbance, MeanOfASenderIsThatOfItsDraws) {
  for (const std::string kind : {"remote", "cosys", "sharedlink", "carrier"}) {
    DisturbanceSettings d{.kind = kind};
    take_defaults(d);
    double share = 0;
    for (std::uint32_t trial = 0; trial < 64; ++trial)
      share += lit_share(draw_disturbance(d, {.trial = trial}, dsp::Seconds(60)).drive, 60) / 64;
    EXPECT_NEAR(share * d.irradiance_w_per_m2 * d.carrier_duty / mean_of(d).value, 1, 0.01) << kind;
  }
}

// Its lines are SharedLink's, each with values of its own, and none is a COSYS message.
TEST(Disturbance, ASharedLinkNodeSendsItsLines) {
  DisturbanceSettings d{.kind = "sharedlink"};
  take_defaults(d);
  d.variables = 3;
  const dsp::LogicTrace drive = draw_disturbance(d, {.seed = 7}, dsp::Seconds(60)).drive;
  protocol::SharedLinkDecoder shared_link;
  protocol::CosysDecoder cosys;
  std::set<std::string> texts;
  int lines = 0;
  for (const auto& byte :
       protocol::find_uart_receiver("atmega")->receive(drive, dsp::Hertz(600), 0)) {
    const auto message = cosys.push(byte);
    EXPECT_FALSE(message && message->outcome == protocol::CosysOutcome::ok);
    const auto frame = shared_link.push(byte);
    if (!frame) continue;
    ++lines;
    ASSERT_EQ(frame->outcome, protocol::SharedLinkOutcome::ok) << frame->text;
    EXPECT_EQ(frame->message.fields.size(), 4U) << "the index and three values";
    texts.insert(frame->text);
  }
  EXPECT_GT(lines, 45) << "0.63 s of message, 0.5 s of pause";
  EXPECT_EQ(texts.size(), static_cast<std::size_t>(lines)) << "values are drawn";
}

// Purposes are apart: with a disturbance more, all else of a trial is drawn as before, and so are
// the disturbances before it.
TEST(Disturbance, LeavesAllOtherDrawsAsTheyWere) {
  const Link without = link_of({"disturbance.a.kind=remote"});
  Link with = link_of({"disturbance.a.kind=remote", "disturbance.b.kind=cosys"});
  ASSERT_NE(with.point, without.point);
  with.point = without.point;
  const Transmission sent = transmit(without, 5), again = transmit(with, 5);
  EXPECT_EQ(sent.line, again.line);
  const auto one = chain_input(without, 5, sent), two = chain_input(with, 5, again);
  EXPECT_EQ(one.noise_seed, two.noise_seed);
  EXPECT_EQ(one.carrier_phase, two.carrier_phase);
  ASSERT_EQ(two.disturbances.size(), 2u);
  EXPECT_EQ(one.disturbances[0].phase, two.disturbances[0].phase);
  EXPECT_EQ(one.disturbances[0].drive, two.disturbances[0].drive);
  EXPECT_NE(two.disturbances[0].phase, two.disturbances[1].phase);
  EXPECT_NE(chain_input(with, 6, again).disturbances[0].phase, two.disturbances[0].phase);
}

// ---- what it does to the link ----

/// Sixteen messages at 1 m.
Tally sixteen(std::vector<std::string> set) {
  set.insert(set.begin(), {"simulation.sample_rate_hz=300000", "simulation.warmup_messages=1",
                           "device.interval_min_ms=300"});
  const Link link = link_of(set);
  Tally tally;
  for (const std::uint32_t first : {0U, 8U}) tally += run_group(link, first, 8).tally;
  return tally;
}

std::uint64_t lost(const std::vector<std::string>& set) { return sixteen(set).n_frames_lost; }

TEST(Disturbance, NothingIsLostWithout) {
  EXPECT_EQ(lost({}), 0u);
  EXPECT_EQ(lost({"disturbance.a.kind=remote", "disturbance.a.irradiance_w_per_m2=0"}), 0u);
}

// A jammer an eighth as bright as the signal kills it by the slow AGC, which takes it for a burst
// without end (Vishay 82459 p. 5: continuous signals are suppressed). A part without AGC follows
// the signal's peak: all bits arrive, but the pin is low before the first one.
TEST(Disturbance, JammerKillsByTheAgc) {
  std::vector<std::string> set{"disturbance.j.kind=carrier",
                               "disturbance.j.irradiance_w_per_m2=0.01"};
  const Tally with = sixteen(set);
  EXPECT_EQ(with.n_frames_lost, 16u);
  EXPECT_GT(with.n_bit_errors, with.n_bits / 4);
  set.emplace_back("module.agc_attack_db_per_ms=0");
  EXPECT_EQ(sixteen(set).n_bit_errors, 0u);
}

TEST(Disturbance, AnotherDeviceInTheDistanceCollidesNowAndThen) {
  const auto with_pause = [](const std::string& pause) {
    return lost({"module.agc_attack_db_per_ms=0", "disturbance.d.kind=cosys",
                 "disturbance.d.interval_min_ms=" + pause,
                 "disturbance.d.interval_max_ms=" + pause});
  };
  EXPECT_GT(with_pause("600"), 2u);
  EXPECT_LT(with_pause("600"), 16u);
  EXPECT_LT(with_pause("9000"), with_pause("0"));
}

// The second line of a ballast at 29 kHz is in the pass-band of a 56 kHz part, that at 37.5 kHz is
// not.
TEST(Disturbance, BallastHitsHardestWhereItsSecondHarmonicPasses) {
  const auto at = [](const std::string& hertz) {
    return lost({"disturbance.l.kind=fluorescent", "disturbance.l.irradiance_w_per_m2=0.002",
                 "disturbance.l.ballast_hz=" + hertz});
  };
  EXPECT_EQ(at("29000"), 16u);
  EXPECT_EQ(at("37500"), 0u);
}

// Lamps of 500 lx: those that only follow the mains take nothing, and a ballast all where its
// second line is in the pass-band.
TEST(Disturbance, AnOfficeIsHeardWhereItsBallastIs) {
  EXPECT_EQ(lost({"disturbance.l.kind=led_panel"}), 0u);
  EXPECT_EQ(lost({"disturbance.l.kind=fluorescent_magnetic"}), 0u);
  const auto at = [](const std::string& hertz) {
    return lost({"disturbance.l.kind=fluorescent_electronic", "disturbance.l.ballast_hz=" + hertz});
  };
  EXPECT_EQ(at("29000"), 16u);
  EXPECT_LT(at("45000"), 8u);
}

// A remote at 38 kHz, 18 dB down, still breaks the link at the light that it has from 1 m away.
TEST(Disturbance, RemoteBreaksTheLink) { EXPECT_GT(lost({"disturbance.r.kind=remote"}), 8u); }

class DisturbanceCommandLine : public CommandLine {};

TEST_F(DisturbanceCommandLine, SweepsABallast) {
  write("s.toml",
        "[disturbance.lamp]\nkind = \"fluorescent\"\n[simulation]\nwarmup_messages = 0\n"
        "sample_rate_hz = 250000\n[stop]\nmax_frames = 8\n");
  const Outcome o = program(
      {"run", "s.toml", "--set", "disturbance.lamp.ballast_hz=28000:500:29000", "-o", "o.h5"});
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(values("o.h5", "disturbance_lamp_ballast_hz"), "28000, 28500, 29000");
}

}  // namespace
}  // namespace sim
