// The picture of a traced trial: what was sent, what was read, and where they differ.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "occurrences.hpp"
#include "program.hpp"
#include "protocol/uart.hpp"
#include "sim/trace/trace_picture.hpp"

namespace {

constexpr dsp::Hertz baud(600), carrier(59e3);

dsp::LogicTrace wire_with(const std::vector<std::string>& messages, double delay_s = 0) {
  dsp::LogicTrace wire;
  dsp::Seconds at(0.01 + delay_s);
  for (const std::string& message : messages) {
    for (const char c : message)
      at = protocol::send_byte(wire, static_cast<std::uint8_t>(c), at, baud);
    at = at + dsp::Seconds(0.3);
  }
  wire.observe_until(at);
  return wire;
}

sim::TracedTrial pictured_trial(const std::vector<std::string>& sent,
                                const std::vector<std::string>& read) {
  sim::TracedTrial trial;
  trial.tx = wire_with(sent);
  trial.rx = wire_with(read, 200e-6);
  trial.sample_rate = dsp::Hertz(472e3);
  trial.carrier = carrier;
  trial.baud = baud;
  return trial;
}

TEST(TracePicture, ShowsTheLastMessageAsSentAndAsRead) {
  const std::string text =
      sim::trace_as_picture(pictured_trial({"AB C\n", "IND 0\n"}, {"AB C\n", "IND 0\n"}));
  EXPECT_NE(text.find("Sent: IND\u24230\\n ; read at the receiver's pin: IND\u24230\\n"),
            std::string::npos)
      << text.substr(0, 400);
  EXPECT_EQ(sim::occurrences(text, "class=\"wrong\""), 0U);
  EXPECT_EQ(sim::occurrences(text, ">N</text>"), 2U);
  EXPECT_EQ(sim::occurrences(text, ">A</text>"), 0U) << "of a message before";
  EXPECT_NE(text.find("Its character 1, "), std::string::npos);
  EXPECT_NE(text.find("The beginning of its start bit, light of 59.0 kHz"), std::string::npos);
}

TEST(TracePicture, PointsAtTheFirstCharacterThatWasReadOtherwise) {
  const std::string text = sim::trace_as_picture(pictured_trial({"IND 0\n"}, {"INE 0\n"}));
  EXPECT_NE(text.find("Its character 3, &quot;D&quot;"), std::string::npos);
  EXPECT_EQ(sim::occurrences(text, "class=\"wrong\""), 2U)
      << "the character, and the bit of it that is not as sent";
  EXPECT_NE(text.find("read at the receiver's pin: INE"), std::string::npos);
  EXPECT_NE(text.find("The pin's edge in its bit 0, which is misread, light of 59.0 kHz"),
            std::string::npos);
}

TEST(TracePicture, TakesTheLightThatWasSampledOrElseThatWasKeyed) {
  sim::TracedTrial trial = pictured_trial({"IND 0\n"}, {"IND 0\n"});
  EXPECT_NE(sim::trace_as_picture(trial).find("as keyed"), std::string::npos);
  trial.taps.irradiance.assign(
      static_cast<std::size_t>(trial.tx.end().value * trial.sample_rate.value), 0.25F);
  trial.taps.irradiance[4800] = 12.5F;
  EXPECT_NE(sim::trace_as_picture(trial).find("to 12.5 mW/m2"), std::string::npos);
  EXPECT_NE(sim::trace_as_picture(trial).find("noise included"), std::string::npos);
}

/// The places of the characters along a line that stands `at` so far down, from left to right.
std::vector<double> places_of(const std::string& text, const std::string& at) {
  std::vector<double> places;
  const std::string begin = "class=\"character\" x=\"";
  for (std::size_t i = text.find(begin); i != std::string::npos; i = text.find(begin, i + 1)) {
    const double x = std::stod(text.substr(i + begin.size()));
    if (text.find(at, i) < text.find('>', i)) places.push_back(x);
  }
  std::ranges::sort(places);
  return places;
}

/// The last text that begins so.
std::string last_of(const std::string& text, const std::string& begin) {
  const std::size_t at = text.rfind(begin);
  return at == std::string::npos ? "none" : text.substr(at, text.find('<', at) - at);
}

TEST(TracePicture, LeavesOutCharactersThatHaveNoRoom) {
  constexpr const char* above_light = "y=\"82.00\"";
  const std::string little = sim::trace_as_picture(pictured_trial({"IND 0\n"}, {"IND 0\n"}));
  EXPECT_EQ(places_of(little, above_light).size(), 6U);
  EXPECT_EQ(little.find("left out"), std::string::npos);
  const std::string much(200, 'A');
  const std::string text = sim::trace_as_picture(pictured_trial({much}, {much + "\n"}));
  const std::vector<double> places = places_of(text, above_light);
  ASSERT_GT(places.size(), 50U);
  for (std::size_t i = 1; i < places.size(); ++i) EXPECT_GE(places[i] - places[i - 1], 10) << i;
  EXPECT_NE(text.find("characters are left out that have no room"), std::string::npos);
}

TEST(TracePicture, LeavesOutNoCharacterThatWasMisreadAmongOthersThatWereNot) {
  std::string read(200, 'A');
  for (const std::size_t i : {3U, 50U, 121U}) read[i] = 'Q';
  const std::string text = sim::trace_as_picture(pictured_trial({std::string(200, 'A')}, {read}));
  EXPECT_EQ(sim::occurrences(text, ">Q</text>"), 3U);
}

TEST(TracePicture, CutsWhatIsTooLongForItsTop) {
  const std::string text =
      sim::trace_as_picture(pictured_trial({std::string(200, 'A')}, {std::string(200, 'B')}));
  const std::string sent = last_of(text, ">Point 0"), read = last_of(text, ">read at the");
  EXPECT_TRUE(sent.ends_with("AAA...")) << sent;
  EXPECT_TRUE(read.ends_with("BBB...")) << read;
  EXPECT_EQ(sent.size(), 126U);
  EXPECT_EQ(read.size(), 126U);
  EXPECT_NE(text.find(std::string(200, 'B') + "</desc>"), std::string::npos) << "whole in words";
}

TEST(TracePicture, StandsWhereNothingWasSentOrRead) {
  const std::string silent = sim::trace_as_picture(pictured_trial({}, {}));
  EXPECT_NE(silent.find("read at the receiver's pin: nothing"), std::string::npos);
  const std::string unheard = sim::trace_as_picture(pictured_trial({"IND 0\n"}, {}));
  EXPECT_NE(unheard.find("Its character 1, "), std::string::npos);
}

sim::TracedTrial trial_with_taps() {
  sim::TracedTrial trial = pictured_trial({"IND 0\n"}, {"IND 0\n"});
  const auto samples = static_cast<std::size_t>(trial.tx.end().value * trial.sample_rate.value) + 1;
  trial.taps = {.irradiance = std::vector<float>(samples, 0.0125F),
                .band_pass = std::vector<float>(samples, -0.25F),
                .threshold = std::vector<float>(samples, 0.25F),
                .integrator = std::vector<float>(samples, 7000),
                .agc_gain = std::vector<float>(samples, 1)};
  return trial;
}

TEST(TracePicture, HasEveryTapInEachOfItsThreePartsWhereAskedTo) {
  sim::TracedTrial trial = trial_with_taps();
  const std::string text = sim::taps_as_picture(trial);
  for (const char* style : {"light", "curve3", "threshold", "curve4", "curve6", "wire"})
    EXPECT_EQ(sim::occurrences(text, fmt::format("<path class=\"{}\"", style)), 3U) << style;
  for (const char* mark : {">0.01</text>", ">-0.2</text>", ">5000</text>", ">0.5</text>"})
    EXPECT_EQ(sim::occurrences(text, mark), 3U) << mark;
  EXPECT_EQ(sim::occurrences(sim::trace_as_picture(trial), "class=\"curve"), 0U);
}

TEST(TracePicture, SaysThatTheSlowAgcRaisesTheThreshold) {
  const std::string text = sim::taps_as_picture(trial_with_taps());
  EXPECT_EQ(sim::occurrences(text, ">threshold raised</text>"), 3U);
  EXPECT_EQ(sim::occurrences(text, ">by slow AGC</text>"), 3U);
  EXPECT_EQ(sim::occurrences(text, ">factor</text>"), 3U);
  EXPECT_EQ(text.find("gain"), std::string::npos) << "more of it would mean that less is needed";
}

TEST(TracePicture, MarksATapThatNothingMoves) {
  sim::TracedTrial trial = trial_with_taps();
  std::ranges::fill(trial.taps.integrator, 0.0F);
  const std::string text = sim::taps_as_picture(trial);
  EXPECT_EQ(text.find("e-1"), std::string::npos) << "no marks such as 5e-13";
  EXPECT_EQ(sim::occurrences(text, ">0.5</text>"), 6U) << "of the integrator and of the gain";
}

TEST(TracePicture, LeavesOutTapsThatWereNotRecorded) {
  sim::TracedTrial trial = trial_with_taps();
  const auto nothing = std::vector<float>(trial.taps.irradiance.size(), std::nanf(""));
  trial.taps.band_pass = trial.taps.threshold = trial.taps.integrator = trial.taps.agc_gain =
      nothing;
  EXPECT_EQ(sim::taps_as_picture(trial), sim::trace_as_picture(trial));
  trial.taps = {};
  EXPECT_EQ(sim::taps_as_picture(trial), sim::trace_as_picture(trial));
}

class TracePictureFile : public CommandLine {};

TEST_F(TracePictureFile, IsWellFormedAndReplacesItsLikeAlone) {
  write("s.toml", "title = \"a <b> & c\"\n");
  EXPECT_EQ(program({"trace", "s.toml", "-o", "x.svg"}).code, 0);
  EXPECT_EQ(program({"trace", "s.toml", "-o", "x.svg"}).code, 0) << "again";
  EXPECT_EQ(std::system(("xmllint --noout " + path("x.svg").string()).c_str()), 0);
  write("mine.svg", "<svg>mine</svg>");
  EXPECT_EQ(program({"trace", "s.toml", "-o", "mine.svg"}).code, 2);
  EXPECT_EQ(content(path("mine.svg")), "<svg>mine</svg>");
}

}  // namespace
