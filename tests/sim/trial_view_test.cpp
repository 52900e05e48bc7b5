// A trial packed for the script of a page: no spike is lost, no time is shifted, what is misread is
// marked.
#include <gtest/gtest.h>
#include <openssl/evp.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "made_up_trial.hpp"
#include "occurrences.hpp"
#include "sim/page/eye_diagram.hpp"
#include "sim/page/shown_trial.hpp"
#include "sim/page/trial_view.hpp"

namespace sim {
namespace {

constexpr double rate = 236e3;

TracedTrial trial_of(const std::string& sent, const std::string& read) {
  TracedTrial trial = made_up_trial(sent, read);
  trial.carrier = dsp::Hertz(59e3);
  trial.sample_rate = dsp::Hertz(rate);
  const auto count = static_cast<std::size_t>(0.5 * rate);
  trial.taps = {std::vector<float>(count, 0.25F),
                std::vector<float>(count, -1),
                std::vector<float>(count, NAN),
                std::vector<float>(count, 0),
                {}};
  return trial;
}

std::size_t sample_at(double time_s) { return static_cast<std::size_t>(time_s * rate); }

TEST(TrialView, HasTheTapsThatWereRecordedOnTheMessagesTime) {
  TracedTrial trial = trial_of("OK\n", "OK\n");
  trial.taps.irradiance[sample_at(0.11)] = 7;
  const TrialView view = view_of(trial);
  ASSERT_EQ(view.taps.size(), 3U)
      << "of a matched receiver the threshold is NaN, the gain not there";
  EXPECT_EQ(view.taps[0].key, "irradiance_mw_per_m2");
  EXPECT_EQ(view.taps[0].unit, "mW/m2");
  EXPECT_EQ(view.taps[2].unit, "");
  const auto& values = view.taps[0].values;
  const auto spike = std::ranges::find(values, 7.0F) - values.begin();
  EXPECT_NEAR(view.first_s + static_cast<double>(spike) * view.period_s, 0.01, 1 / rate);
  EXPECT_NEAR(view.message_s, 0.05, 1e-9);
  EXPECT_NEAR(view.first_s, -0.01, 1 / rate);
}

TEST(TrialView, HasAGainOnlyOfModulesWithASlowAgc) {
  TracedTrial trial = trial_of("OK\n", "OK\n");
  trial.taps.agc_gain = std::vector<float>(trial.taps.irradiance.size(), 1);
  EXPECT_EQ(view_of(trial).taps.back().key, "agc_gain");
  trial.has_slow_agc = false;
  EXPECT_EQ(view_of(trial).taps.back().key, "integrator_samples");
}

TEST(TrialView, LosesNoSpikeWhereItKeepsFewerValues) {
  TracedTrial trial = trial_of("OK\n", "OK\n");
  trial.taps.irradiance[sample_at(0.1234)] = 9;
  trial.taps.irradiance[sample_at(0.1345)] = -9;
  const TrialView view = view_of(trial, 100);
  const auto& values = view.taps[0].values;
  EXPECT_LE(values.size(), 102U);
  EXPECT_GE(values.size(), 40U);
  const auto time_of = [&](float value) {
    return view.first_s +
           static_cast<double>(std::ranges::find(values, value) - values.begin()) * view.period_s;
  };
  EXPECT_NEAR(time_of(9), 0.0234, 2 * view.period_s);
  EXPECT_NEAR(time_of(-9), 0.0345, 2 * view.period_s);
}

TEST(TrialView, KeepsTheSpikesOfTenMillionSamples) {
  TracedTrial trial = trial_of("OK\n", "OK\n");
  trial.sample_rate = dsp::Hertz(120e6);
  trial.taps = {};
  trial.taps.irradiance.resize(25'000'000, 0.25F);
  const auto sample_of = [](double time_s) { return static_cast<std::size_t>(time_s * 120e6); };
  const std::size_t stretch = view_of(trial).stretch, somewhere = sample_of(0.12);
  EXPECT_EQ(stretch, 22U) << "10.8 million samples, two values of each stretch";
  const std::size_t apart = 50 * stretch + 1;  // so that each has another place in its stretch
  for (std::size_t i = 0; i < stretch; ++i)
    trial.taps.irradiance[somewhere + apart * i] = 1 + static_cast<float>(i);
  const TrialView view = view_of(trial);
  const auto& values = view.taps[0].values;
  EXPECT_LE(values.size(), 1'000'000U);
  for (std::size_t i = 0; i < stretch; ++i) {
    const auto spike = std::ranges::find(values, 1 + static_cast<float>(i)) - values.begin();
    EXPECT_NEAR(view.first_s + static_cast<double>(spike) * view.period_s,
                0.02 + static_cast<double>(apart * i) / 120e6, 2 * view.period_s)
        << i;
  }
}

TEST(TrialView, KeepsEverySampleAboutTheCharacterThatIsShownFirst) {
  TracedTrial trial = trial_of("OK\n", "OJ\n");
  for (std::size_t i = 0; i < trial.taps.irradiance.size(); ++i)
    trial.taps.irradiance[i] = static_cast<float>(i % 1000);
  EXPECT_TRUE(view_of(trial).taps[0].detail.empty()) << "all of them have every sample";
  const TrialView view = view_of(trial, 20'000);
  ASSERT_GT(view.stretch, 1U);
  const auto& detail = view.taps[0].detail;
  const double end_s = view.detail_first_s + static_cast<double>(detail.size()) / rate;
  EXPECT_LT(view.detail_first_s, view.byte_from_s - view.byte_s / 10);
  EXPECT_GT(end_s, view.byte_from_s + 1.1 * view.byte_s);
  const std::size_t first = sample_at(0.1 + view.detail_first_s);
  for (std::size_t i = 0; i < detail.size(); ++i)
    ASSERT_EQ(detail[i], trial.taps.irradiance[first + i]) << i;
  EXPECT_EQ(view_of(trial, 100).taps[0].detail.size(), 50U);
}

TEST(TrialView, MarksWhatWasMisread) {
  const TrialView view = view_of(trial_of("OK\n", "OJ\n"));
  ASSERT_EQ(view.sent.size(), 3U);
  ASSERT_EQ(view.read.size(), 3U);
  EXPECT_EQ(view.read[1].text, "J");
  EXPECT_TRUE(view.read[1].is_wrong);
  EXPECT_FALSE(view.read[0].is_wrong);
  EXPECT_EQ(view.read[2].text, "\\n");
  EXPECT_NEAR(view.byte_from_s, 10 / made_up_baud.value, 1e-9) << "the second is shown first";
  EXPECT_EQ(view.bits.size(), 30U);
  EXPECT_EQ(std::ranges::count(view.bits, true, &ViewMark::is_wrong), 1)
      << "K and J: the last bit of them";
  EXPECT_TRUE(view.wire_begins);
  EXPECT_NEAR(view.wire_edges_s.front(), 0.0002, 1e-9);
}

TEST(TrialView, ShowsTheCyclesWhereTheFirstWrongBitGoesWrong) {
  const double bit_s = 1 / made_up_baud.value, cycle_s = 1 / 59e3;
  const auto from_s = [&](const std::string& sent, const std::string& read) {
    const TrialView view = view_of(trial_of(sent, read));
    EXPECT_NEAR(view.edge_to_s - view.edge_from_s, 30 * cycle_s, 1e-9);
    return view.edge_from_s;
  };
  EXPECT_NEAR(from_s("OJ\n", "OK\n"), 11 * bit_s + 200e-6 - 25 * cycle_s, 1e-9)
      << "before the pin turns dark in bit 0";
  EXPECT_NEAR(from_s("OK\n", "OJ\n"), 11 * bit_s - 5 * cycle_s, 1e-9)
      << "of bit 0 the pin has no edge";
  EXPECT_NEAR(from_s("OK\n", "OK\n"), -5 * cycle_s, 1e-9) << "the start bit: none is wrong";
}

TEST(TrialView, ComparesBitsWithThoseOfAPinThatIsLater) {
  TracedTrial trial = made_up_trial("OK\n", "");
  trial.rx = dsp::LogicTrace();
  send_at(trial.rx, "OK\n", 0.1 + 1 / made_up_baud.value);
  const auto wrong = [&] {
    return std::ranges::count(view_of(trial).bits, true, &ViewMark::is_wrong);
  };
  EXPECT_GT(wrong(), 0);
  trial.delay = dsp::period(made_up_baud);
  EXPECT_EQ(wrong(), 0);
  EXPECT_EQ(view_of(trial).delay_s, trial.delay.value);
}

TEST(TrialView, IsPackedInSixteenBits) {
  TracedTrial trial = trial_of("OK\n", "OK\n");
  for (std::size_t i = 0; i < trial.taps.irradiance.size(); ++i)
    trial.taps.irradiance[i] = static_cast<float>(std::sin(static_cast<double>(i)));
  const TrialView view = view_of(trial);
  const auto tap = nlohmann::json::parse(view_json(view))["taps"][0];
  const std::string text = tap["values"];
  std::vector<unsigned char> bytes(3 * text.size() / 4);
  ASSERT_GT(EVP_DecodeBlock(bytes.data(), reinterpret_cast<const unsigned char*>(text.data()),
                            static_cast<int>(text.size())),
            0);
  const double least = tap["least"], greatest = tap["greatest"];
  for (std::size_t i = 0; i < view.taps[0].values.size(); ++i)
    ASSERT_NEAR(least + (bytes[2 * i] + 256 * bytes[2 * i + 1]) * (greatest - least) / 65535,
                view.taps[0].values[i], 2e-5);
}

// ---- pictures of a trial ----

ShownTrial shown_of(TracedTrial trial) { return {std::move(trial), {}}; }

double most_at(const ChartCurve& curve) {
  return std::ranges::max(curve.points, {}, &ChartPoint::y).x;
}

TEST(ShownTrial, DrawsAnEyeOfAllBits) {
  const std::string svg = eye_as_svg(shown_of(trial_of("OK\n", "OK\n")));
  EXPECT_EQ(occurrences(svg, "class=\"eye\""), 30U);
  EXPECT_EQ(occurrences(svg, "class=\"misread\""), 0U);
}

TEST(ShownTrial, DrawsMisreadBitsOfItsEyeOnTop) {
  const std::string svg = eye_as_svg(shown_of(trial_of("OK\n", "OJ\n")));
  EXPECT_EQ(occurrences(svg, "<path class=\"eye\""), 29U);
  EXPECT_EQ(occurrences(svg, "<path class=\"misread\""), 1U);
  EXPECT_GT(svg.find("<path class=\"misread\""), svg.rfind("<path class=\"eye\""));
  EXPECT_EQ(occurrences(svg, ">misread at the pin: 1 of 30 bits</text>"), 1U);
}

TEST(ShownTrial, DrawsWhereThePinSwitchesAndABitIsRead) {
  const PagePicture eye = eye_picture(shown_of(trial_of("OK\n", "OK\n")));
  EXPECT_EQ(occurrences(eye.svg, "<line class=\"level\""), 3U);
  EXPECT_EQ(occurrences(eye.svg, "<line class=\"level\" x1=\"235.00\" y1=\"50.00\""), 1U)
      << "in the middle of the first of two bits";
  EXPECT_NE(eye.caption.find("from 0 to 33.7, which are 8 cycles of 56 kHz"), std::string::npos)
      << "8 / 56 kHz * 236 kS/s";
}

TEST(ShownTrial, ShowsTheCarrierInItsSpectrumUnderTheModulesResponse) {
  TracedTrial trial = trial_of("OK\n", "OK\n");
  constexpr double carrier = 59e3;
  for (std::size_t i = 0; i < trial.taps.irradiance.size(); ++i)
    trial.taps.irradiance[i] = static_cast<float>(
        std::sin(2 * std::numbers::pi * carrier * static_cast<double>(i) / rate));
  const Chart chart = spectrum_chart(shown_of(std::move(trial)));
  ASSERT_EQ(chart.curves.size(), 3U);
  EXPECT_NEAR(most_at(chart.curves[0]), 59, 0.1);
  EXPECT_NEAR(most_at(chart.curves[2]), 56, 0.1) << "f0 of the module";
  const auto half = std::ranges::find_if(chart.curves[2].points,
                                         [](const ChartPoint& p) { return p.x > 56 * 1.05; });
  EXPECT_NEAR(half->y / std::ranges::max(chart.curves[2].points, {}, &ChartPoint::y).y, 0.5, 0.03)
      << "3 dB width f0/10, Vishay 82459 rev 1.8 Fig. 5";
}

}  // namespace
}  // namespace sim
