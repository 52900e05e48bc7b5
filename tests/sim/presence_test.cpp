// Presence by intensity: what is counted beside the closed forms, and those beside integrals.
#include "sim/location/presence.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "protocol/cosys.hpp"
#include "sim/failure.hpp"
#include "sim/location/presence_point.hpp"

namespace sim {
namespace {

constexpr Detector all_detectors[] = {Detector::synchronous, Detector::goertzel,
                                      Detector::dc_difference};

TEST(DetectionTheory, DetectsNothingButFalseAlarmsWithoutLight) {
  for (const Detector detector : all_detectors)
    for (const double pfa : {1e-6, 0.01, 0.5, 0.9})
      EXPECT_NEAR(detection_probability(detector, pfa, {}), pfa, 1e-9 * pfa);
}

TEST(DetectionTheory, IsAGaussianShift) {  // Q(Q^-1(1e-3) - 4): Python, statistics.NormalDist
  EXPECT_NEAR(detection_threshold(Detector::synchronous, 1e-3), 3.090232, 1e-6);
  EXPECT_NEAR(detection_probability(Detector::synchronous, 1e-3, {4, 1}), 0.8185275, 1e-7);
  EXPECT_NEAR(detection_probability(Detector::dc_difference, 1e-3, {4, 2}), 0.6754036, 1e-7);
}

/// P(r^2 > t) of Rice's law by the trapezoid rule: r exp(-(r^2 + a^2) / 2) I0(a r).
double rice_tail(double a, double threshold) {
  constexpr double step = 1e-4;
  double sum = 0;
  for (double r = std::sqrt(threshold) + step / 2; r < a + 12; r += step)
    sum += r * std::exp(-(r * r + a * a) / 2) * std::cyl_bessel_i(0.0, a * r) * step;
  return sum;
}

TEST(DetectionTheory, GoertzelIsRicesLaw) {
  for (const double a : {0.5, 3.0, 5.0})
    EXPECT_NEAR(detection_probability(Detector::goertzel, 0.01, {a * a, 1}),
                rice_tail(a, -2 * std::log(0.01)), 1e-7)
        << a;
}

TEST(DetectionTheory, WideningIsAnotherUnitOfNoise) {
  EXPECT_NEAR(detection_probability(Detector::goertzel, 0.01, {9, 1.5}),
              rice_tail(2, -2 * std::log(0.01) / 2.25), 1e-7);
}

/// A BPW34 (Vishay 81521) in room light, noise well above the ADC's step.
PresenceSettings faint_light(Detector detector, double microwatts_per_m2) {
  PresenceSettings s;
  s.meter.photodiode.responsivity_a_per_w = 0.6667;
  s.meter.adc_bits = 16;
  s.light.signal = dsp::WattsPerSquareMetre(microwatts_per_m2 * 1e-6);
  s.light.ambient = dsp::WattsPerSquareMetre(0.6);
  s.detector = detector;
  s.window_samples = s.reference_samples = 400;
  s.trials = 4000;
  s.level = 0.9999;  // of each of some dozens of intervals
  return s;
}

void expect_closed_form(const PresenceSettings& settings) {
  const PresenceResult result = measure_presence(settings);
  EXPECT_GT(result.noise_over_step, 0.5);
  EXPECT_EQ(result.clipped, 0);
  for (const RocPoint& roc : result.roc) {
    EXPECT_LE(roc.false_alarm.low, roc.pfa);
    EXPECT_GE(roc.false_alarm.high, roc.pfa);
    EXPECT_LE(roc.detection.low, roc.detection_theory);
    EXPECT_GE(roc.detection.high, roc.detection_theory);
    EXPECT_GT(roc.detection_theory, 1.5 * roc.pfa);  // or nothing is compared
    EXPECT_LT(roc.detection_theory, 0.98);
  }
}

TEST(Presence, CountsWhatTheClosedFormSays) {
  for (const Detector detector : all_detectors) {
    SCOPED_TRACE(static_cast<int>(detector));
    expect_closed_form(faint_light(detector, 12));
  }
}

TEST(Presence, SoItDoesWithASlowAdcThatSeesAnAlias) {
  for (const Detector detector : {Detector::synchronous, Detector::goertzel}) {
    SCOPED_TRACE(static_cast<int>(detector));
    PresenceSettings s = faint_light(detector, 25);
    s.meter.sample_rate_hz = 20e3;  // 59 kHz is 1 kHz
    s.meter.aperture = 0.1;
    expect_closed_form(s);
  }
}

TEST(Presence, SoItDoesInsideOfAMessage) {
  for (const Detector detector : all_detectors)
    for (const double pulse_s : {0.0, 1.2e-3}) {
      SCOPED_TRACE(fmt::format("{} {}", static_cast<int>(detector), pulse_s));
      PresenceSettings s = faint_light(detector, 16);
      s.keyed = KeyedMessage{.pulse = dsp::Seconds(pulse_s)};
      expect_closed_form(s);
    }
}

/// In the dark with a resistor of no noise to speak of: 2 nA without light, 6 nA on average with
/// it.
TEST(Presence, ShotNoiseOfTheLightWidensTheLaw) {
  PresenceSettings s = faint_light(Detector::goertzel, 8e-9 / (7.5e-6 * 0.6667) * 1e6);
  s.light.ambient = {};
  s.meter.feedback_ohm = 1e12;
  s.meter.full_scale_v = 1e5;
  s.meter.adc_bits = 24;
  EXPECT_NEAR(PresencePoint(s).law(0, 0).widening, std::sqrt(3), 1e-3);
  s.detector = Detector::dc_difference;  // (3 / 400 + 1 / 1200) / (1 / 400 + 1 / 1200)
  s.reference_samples = 1200;
  EXPECT_NEAR(PresencePoint(s).law(0, 0).widening, std::sqrt(2.5), 1e-3);
}

/// Q(Q^-1(pfa) - sqrt(E / s^2)) by hand: the square wave of 59 kHz as 200 kS/s means has most of
/// its energy in the fundamental; with all of it the shift would be A / 2 sqrt(N) / s.
TEST(Presence, SynchronousShiftIsTheRootOfTheEnergy) {
  PresenceSettings s = faint_light(Detector::synchronous, 100);
  s.meter.sample_rate_hz = 10e6;
  s.window_samples = 10000;
  s.trials = 0;
  const PresenceResult result = measure_presence(s);
  const double volts = 100e-6 * 7.5 * 0.6667;
  EXPECT_NEAR(result.signal, volts / 2 * std::sqrt(1e4) / result.noise_v, 0.005 * result.signal);
}

TEST(Presence, KnownPhaseDetectsMoreThanUnknown) {
  const auto detected = [](Detector detector) {
    PresenceSettings s = faint_light(detector, 12);
    s.trials = 0;
    return measure_presence(s).roc.front().detection_theory;
  };
  EXPECT_GT(detected(Detector::synchronous), 1.5 * detected(Detector::goertzel));
}

TEST(Presence, ACarrierBesideTheDetectorsIsLost) {  // a bin is 500 Hz: three are off
  for (const Detector detector : {Detector::synchronous, Detector::goertzel}) {
    PresenceSettings s = faint_light(detector, 30);
    s.trials = 0;
    const double tuned = measure_presence(s).signal;
    s.light.carrier = dsp::Hertz(60.5e3);
    EXPECT_LT(measure_presence(s).signal, 0.05 * tuned);
  }
}

/// Of the default message: zeros, and bits up to the last of them.
std::pair<double, double> lit_of_all() {
  const auto bits = protocol::line_bits(protocol::cosys_encode(KeyedMessage{}.message));
  const auto last = std::find(bits.rbegin(), bits.rend(), false);
  return {static_cast<double>(std::ranges::count(bits, false)),
          static_cast<double>(bits.rend() - last)};
}

TEST(Presence, KeyedLightIsThereForTheMessagesShareOfTheTime) {
  PresenceSettings s = faint_light(Detector::dc_difference, 30);
  s.trials = 0;
  const double steady = measure_presence(s).signal;
  s.keyed = KeyedMessage{};
  const auto [lit, all] = lit_of_all();
  EXPECT_NEAR(measure_presence(s).signal / steady, lit / all, 0.02);
  EXPECT_NE(PresencePoint(s).law(0, 0.2).signal, PresencePoint(s).law(0, 0.7).signal);
}

TEST(Presence, RoundingCountsAsNoise) {  // half a step of noise: a third is added
  PresenceSettings s = faint_light(Detector::dc_difference, 20);
  s.meter.adc_bits = 13;
  expect_closed_form(s);
}

TEST(Presence, IsTheSameAgainAndOtherForAnotherSeed) {
  PresenceSettings s = faint_light(Detector::goertzel, 12);
  s.trials = 500;
  const PresenceResult one = measure_presence(s), again = measure_presence(s);
  s.seed = 2;
  const PresenceResult other = measure_presence(s);
  EXPECT_EQ(one.roc[2].detections, again.roc[2].detections);
  EXPECT_EQ(one.roc[2].false_alarms, again.roc[2].false_alarms);
  EXPECT_NE(one.roc[2].detections, other.roc[2].detections);
}

TEST(Presence, TooMuchLightIsSeenAsClipped) {
  PresenceSettings s = faint_light(Detector::goertzel, 12);
  s.light.ambient = dsp::WattsPerSquareMetre(2);
  s.trials = 10;
  EXPECT_EQ(measure_presence(s).clipped, 1);
}

std::string refusal_of(const PresenceSettings& settings) {
  try {
    measure_presence(settings);
  } catch (const Failure& failure) {
    return failure.what();
  }
  return "accepted";
}

TEST(Presence, RefusesWhatCannotBeSeen) {
  for (const Detector detector : {Detector::synchronous, Detector::goertzel}) {
    PresenceSettings s = faint_light(detector, 12);
    s.meter.sample_rate_hz = 29.5e3;
    EXPECT_EQ(refusal_of(s),
              "presence.tuned_hz = 59000 with presence.adc_rate_hz = 29500 (to it the carrier "
              "looks like steady "
              "light) take another sample rate");
  }
}

TEST(Presence, RefusesAWindowBeyondTheMessage) {
  PresenceSettings s = faint_light(Detector::dc_difference, 12);
  s.keyed = KeyedMessage{};
  s.window_samples = 60000;  // 300 ms; the message has 283
  EXPECT_TRUE(refusal_of(s).starts_with("presence.window_ms = 300 (the message's light ends "))
      << refusal_of(s);
}

}  // namespace
}  // namespace sim
