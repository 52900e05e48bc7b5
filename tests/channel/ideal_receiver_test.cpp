// Matched receivers: trials run at once are each the trial alone, to the last bit; a clear link
// is the identity plus one bit; what a lit bit measures depends on neither sample rate nor carrier.
#include "channel/ideal_receiver.hpp"

#include <cmath>
#include <random>

#include "channel/chain.hpp"
#include "gtest/gtest.h"

namespace channel {
namespace {

constexpr dsp::Seconds bit(1 / 600.0);

/// Random bits on a wire, dark at both ends.
struct Sent {
  dsp::LogicTrace wire{true};
  BitSlots slots;
};

Sent random_bits(std::mt19937& random, int bits) {
  Sent sent;
  const dsp::Seconds start(3e-3 + 1e-6 * static_cast<double>(random() % 1000));
  for (int i = 0; i < bits; ++i) {
    sent.slots.push_back({start + bit * i, start + bit * (i + 1)});
    sent.wire.set_at(sent.slots.back().begin, random() % 2 == 0);
  }
  sent.wire.set_at(sent.slots.back().end, true);
  sent.wire.observe_until(sent.slots.back().end + dsp::Seconds(4e-3));
  return sent;
}

constexpr double peak = 1;  // mW/m2

ChainDesign design_of(double carrier_hz, double rate_hz, double noise_scale) {
  return design_chain(ModuleData{},
                      {.signal = dsp::WattsPerSquareMetre(peak * 1e-3),
                       .ambient = dsp::WattsPerSquareMetre(5),
                       .carrier = dsp::Hertz(carrier_hz),
                       .noise_scale = noise_scale},
                      dsp::Hertz(rate_hz));
}

using Statistic = IdealDesign::Statistic;

IdealDesign receiver(Statistic statistic, double threshold) {
  return {statistic, threshold * fundamental_of(peak, 0.5), bit};
}

TEST(IdealReceiverDeterminism, ManyTogetherAreEachAlone) {
  constexpr std::uint32_t trials = 12;
  std::mt19937 random(1);
  std::vector<Sent> sent;
  for (std::uint32_t i = 0; i < trials; ++i)
    sent.push_back(random_bits(random, 20 + 7 * static_cast<int>(i % 8)));
  std::vector<ChainInput> inputs;
  std::vector<BitSlots> slots;
  for (std::uint32_t i = 0; i < trials; ++i) {
    inputs.push_back(
        {.drive = &sent[i].wire, .carrier_phase = i * 7919u << 16, .noise_seed = {i, 1, 2, 3}});
    slots.push_back(sent[i].slots);
  }
  const ChainDesign design = design_of(59e3, 3e5, 300);
  for (const auto statistic : {Statistic::in_phase, Statistic::envelope}) {
    const IdealDesign ideal = receiver(statistic, 0.5);
    const auto together = detect(design, ideal, inputs, slots);
    ASSERT_EQ(together.size(), trials);
    for (std::size_t i = 0; i < trials; ++i)
      EXPECT_EQ(together[i], detect_alone(design, ideal, inputs[i], slots[i])) << "lane " << i;
    for (const InstructionSet set : {InstructionSet::v3, InstructionSet::baseline})
      EXPECT_EQ(detect(design, ideal, inputs, slots, nullptr, set), together);
    const auto some =
        detect(design, ideal, std::span(inputs).subspan(2, 3), std::span(slots).subspan(2, 3));
    EXPECT_EQ(some[1], together[3]) << "neighbours must not matter";
  }
}

// Sums are moved out of the vectors on one grid for all: the same to the last bit, not nearly.
TEST(IdealReceiverDeterminism, SumsOfALaneAreThoseOfTheLaneAlone) {
  std::mt19937 random(5);
  std::normal_distribution<float> normal;
  const SlotSamples slots[2][2] = {{{17, 700}, {700, 1300}}, {{90, 1111}, {1200, 1290}}};
  Correlator<dsp::Lanes8> all(123456789u);
  Correlator<float> alone(123456789u);
  for (int i = 0; i < 8; ++i) all.load(i, slots[i % 2], static_cast<std::uint32_t>(i) << 28);
  alone.load(0, slots[1], 3u << 28);
  std::vector<SlotSums> lane3, only;
  for (int first = 0; first < 1536; first += 256) {
    dsp::Lanes8 x[256];
    float y[256];
    for (int i = 0; i < 256; ++i) {
      for (int lane = 0; lane < 8; ++lane) dsp::set_lane(x[i], lane, normal(random));
      y[i] = dsp::lane(x[i], 3);
    }
    all(first, x, 256, [&](int lane, const SlotSums& s) {
      if (lane == 3) lane3.push_back(s);
    });
    alone(first, y, 256, [&](int, const SlotSums& s) { only.push_back(s); });
  }
  ASSERT_EQ(lane3.size(), 2u);
  ASSERT_EQ(only.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(lane3[i].in_phase, only[i].in_phase);
    EXPECT_EQ(lane3[i].quadrature, only[i].quadrature);
  }
}

dsp::LogicTrace heard(const Sent& sent, const ChainDesign& design, const IdealDesign& ideal,
                      std::uint32_t phase) {
  const ChainInput input{.drive = &sent.wire, .carrier_phase = phase, .noise_seed = {1, 2, 3, 4}};
  return detect_alone(design, ideal, input, sent.slots);
}

TEST(IdealReceiver, ClearLinkIsTheIdentityOneBitLate) {
  std::mt19937 random(2);
  const Sent sent = random_bits(random, 200);
  for (const auto statistic : {Statistic::in_phase, Statistic::envelope}) {
    const auto pin = heard(sent, design_of(59e3, 3e5, 0), receiver(statistic, 0.5), 12345u << 8);
    ASSERT_EQ(pin.edges().size(), sent.wire.edges().size());
    for (std::size_t i = 0; i < pin.edges().size(); ++i)
      EXPECT_DOUBLE_EQ(pin.edges()[i].value, (sent.wire.edges()[i] + bit).value);
    EXPECT_EQ(pin.end(), sent.wire.end() + bit);
  }
}

/// Whether all lit bits measure the amplitude of the fundamental within 1.5 %: they pass a
/// threshold as far below it, and none passes one as far above it. What remains is the light's mean
/// and second harmonic, over bits that do not hold whole cycles, and bits that do not hold whole
/// samples.
void expect_full_amplitude(double carrier_hz, double rate_hz, Statistic statistic) {
  std::mt19937 random(3);
  const ChainDesign design = design_of(carrier_hz, rate_hz, 0);
  for (int round = 0; round < 4; ++round) {
    const Sent sent = random_bits(random, 60);
    const auto phase = static_cast<std::uint32_t>(random());
    EXPECT_EQ(heard(sent, design, receiver(statistic, 0.985), phase).edges().size(),
              sent.wire.edges().size())
        << carrier_hz << " Hz at " << rate_hz;
    EXPECT_EQ(heard(sent, design, receiver(statistic, 1.015), phase).edges().size(), 0u)
        << carrier_hz << " Hz at " << rate_hz;
  }
}

TEST(IdealReceiver, SampleRateDoesNotMoveTheAmplitude) {
  for (const double sample_rate : {2.5e5, 3e5, 5e5, 6e5, 1e6, 2.4e6})
    for (const auto statistic : {Statistic::in_phase, Statistic::envelope})
      expect_full_amplitude(59e3, sample_rate, statistic);
}

// 57 600 and 58 800 Hz are 96 and 98 cycles a bit of 600 Bd, the others no whole number.
TEST(IdealReceiver, CyclesOfABitNeedNotBeWhole) {
  for (const double carrier : {57600.0, 58800.0, 59000.0, 59100.0, 58877.3})
    for (const auto statistic : {Statistic::in_phase, Statistic::envelope})
      expect_full_amplitude(carrier, 6e5, statistic);
}

TEST(IdealReceiver, RecordingHasTheIrradianceAndNoStagesOfAModule) {
  std::mt19937 random(4);
  const Sent sent = random_bits(random, 20);
  const ChainInput input{.drive = &sent.wire, .carrier_phase = 7, .noise_seed = {1, 2, 3, 4}};
  const ChainDesign design = design_of(59e3, 3e5, 1);
  Recording of_module, of_matched;
  propagate_alone(design, input, &of_module);
  detect_alone(design, receiver(Statistic::in_phase, 0.5), input, sent.slots, &of_matched);
  EXPECT_EQ(of_matched.irradiance, of_module.irradiance) << "both hear the same light";
  ASSERT_EQ(of_matched.threshold.size(), of_module.threshold.size());
  EXPECT_TRUE(std::isnan(of_matched.threshold.front()));
}

}  // namespace
}  // namespace channel
