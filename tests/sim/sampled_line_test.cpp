// Lines in samples: light on a carrier, basebands and voltages, with noise and other light.
#include "sim/capture/sampled_line.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "capture_lines.hpp"
#include "sim/capture/autobaud.hpp"

namespace sim {
namespace {

using dsp::Hertz;
using dsp::LogicTrace;
using dsp::Seconds;
using test::Random;
using test::uniform;
using Samples = std::vector<std::complex<float>>;

class Recorded : public SampleCapture {
 public:
  Recorded(Samples samples, Hertz rate, bool is_complex)
      : samples_(std::move(samples)), rate_(rate), complex_(is_complex) {}
  Hertz sample_rate() const override { return rate_; }
  bool is_complex() const override { return complex_; }
  std::size_t read(std::span<std::complex<float>> to) override {
    const std::size_t n = std::min(to.size(), samples_.size() - next_);
    std::copy_n(samples_.begin() + static_cast<std::ptrdiff_t>(next_), n, to.begin());
    next_ += n;
    return n;
  }

 private:
  Samples samples_;
  Hertz rate_;
  bool complex_;
  std::size_t next_ = 0;
};

struct Light {
  double carrier = 59e3, rate = 500e3, noise = 0, ripple = 0;
};

/// A square carrier where the line is 0, ambient light and its 100 Hz ripple.
Samples light_of(const LogicTrace& line, const Light& light, Random& random) {
  Samples samples;
  dsp::TraceReader reader(line);
  for (double i = 0; i / light.rate < line.end().value; ++i) {
    const double t = i / light.rate, turns = t * light.carrier;
    const bool lit = !reader.level_at(Seconds(t)) && turns - std::floor(turns) < 0.5;
    const double ripple = light.ripple * (1 + std::sin(2 * std::numbers::pi * 100 * t));
    samples.emplace_back(static_cast<float>(lit + ripple + 5 + light.noise * test::normal(random)));
  }
  return samples;
}

protocol::Bytes bytes_of(SampledLine& line, double baud) {
  LogicTrace trace(line.initial());
  while (const auto edge = line.next()) trace.add_edge(*edge);
  trace.observe_until(line.known_until());
  protocol::Bytes bytes;
  for (const auto& byte : protocol::receive_mid_bit(trace, Hertz(baud))) {
    EXPECT_FALSE(byte.framing_error);
    bytes.push_back(byte.value);
  }
  return bytes;
}

protocol::Bytes sent_bytes(const LogicTrace& line, double baud) {
  protocol::Bytes bytes;
  for (const auto& byte : protocol::receive_mid_bit(line, Hertz(baud))) bytes.push_back(byte.value);
  return bytes;
}

TEST(SampledLine, FindsTheCarrierAndReadsTheLight) {
  Random random(51);
  for (int trial = 0; trial < 20; ++trial) {
    Light light{uniform(random, 30e3, 70e3), uniform(random, 200e3, 500e3)};
    light.noise = uniform(random, 0, 0.3);
    light.ripple = uniform(random, 0, 2);
    const LogicTrace sent = test::bent_line(random, 2, 600, {});
    Recorded capture(light_of(sent, light, random), Hertz(light.rate), false);
    SampledLine line(capture, {});
    EXPECT_NEAR(line.carrier().value, light.carrier, 150) << trial;
    EXPECT_TRUE(line.initial());
    EXPECT_EQ(bytes_of(line, 600), sent_bytes(sent, 600)) << trial;
  }
}

// Edges are those of the light, the envelope's delay taken off: within the window of ten cycles.
TEST(SampledLine, HasItsEdgesWhereTheLightHas) {
  Random random(52);
  const LogicTrace sent = test::bent_line(random, 2, 600, {});
  Recorded capture(light_of(sent, {}, random), Hertz(500e3), false);
  SampledLine line(capture, {.carrier = Hertz(59e3), .baud = {}});
  for (const Seconds edge : sent.edges()) {
    const auto found = line.next();
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->value, edge.value, 1 / 59e3);
  }
  EXPECT_FALSE(line.next());
}

TEST(SampledLine, WaitsForLightThroughSilence) {
  Random random(53);
  const LogicTrace message = test::bent_line(random, 1, 600, {});
  LogicTrace late;
  for (const Seconds edge : message.edges()) late.add_edge(edge + Seconds(3));
  late.observe_until(message.end() + Seconds(3));
  for (const bool told : {false, true}) {
    Recorded capture(light_of(late, {.noise = 0.1}, random), Hertz(500e3), false);
    SampledLine line(capture,
                     {.carrier = told ? std::optional(Hertz(59e3)) : std::nullopt, .baud = {}});
    EXPECT_EQ(bytes_of(line, 600), sent_bytes(message, 600));
  }
}

// Noise of a hundredth of the swing is no line, however long it lasts.
TEST(SampledLine, WaitsForAVoltageThroughNoise) {
  Random random(76);
  const LogicTrace sent = test::bent_line(random, 2, 9600, {});
  Samples samples;
  const auto add = [&](bool level) {
    samples.emplace_back(static_cast<float>(3.3 * level + 0.03 * test::normal(random)));
  };
  for (int i = 0; i < 2'400'000; ++i) add(true);
  dsp::TraceReader reader(sent);
  for (double i = 0; i / 1e5 < sent.end().value; ++i) add(reader.level_at(Seconds(i / 1e5)));
  Recorded recorded(std::move(samples), Hertz(1e5), false);
  SampledLine line(recorded, {});
  EXPECT_EQ(bytes_of(line, 9600), sent_bytes(sent, 9600));
  EXPECT_NEAR(line.known_until().value, 24 + sent.end().value, 1e-4);
}

// The last samples are fewer than are looked at together.
TEST(SampledLine, FindsLightAtTheVeryEnd) {
  Random random(77);
  const LogicTrace message = test::bent_line(random, 1, 4800, {});
  for (const double silence : {0.6, 5.2}) {
    LogicTrace late;
    for (const Seconds edge : message.edges()) late.add_edge(edge + Seconds(silence));
    late.observe_until(message.end() + Seconds(silence));
    Recorded capture(light_of(late, {.noise = 0.05}, random), Hertz(500e3), false);
    SampledLine line(capture, {.carrier = {}, .baud = Hertz(4800)});
    EXPECT_TRUE(line.is_heard()) << silence;
    EXPECT_NEAR(line.carrier().value, 59e3, 100) << silence;
    EXPECT_EQ(bytes_of(line, 4800), sent_bytes(message, 4800)) << silence;
  }
}

TEST(SampledLine, FollowsLightThatFades) {
  Random random(54);
  const LogicTrace sent = test::bent_line(random, 30, 600, {});
  Samples samples = light_of(sent, {.rate = 250e3}, random);
  for (std::size_t i = 0; i < samples.size(); ++i)  // to a fifth
    samples[i] *=
        static_cast<float>(1 - 0.8 * static_cast<double>(i) / static_cast<double>(samples.size()));
  Recorded capture(samples, Hertz(250e3), false);
  SampledLine line(capture, {});
  EXPECT_EQ(bytes_of(line, 600), sent_bytes(sent, 600));
}

TEST(SampledLine, ReadsABaseband) {
  Random random(55);
  const LogicTrace sent = test::bent_line(random, 2, 600, {});
  Samples samples;
  for (double i = 0; i / 50e3 < sent.end().value; ++i) {
    const double t = i / 50e3;
    const auto light = std::polar(sent.level_at(Seconds(t)) ? 0.0 : 0.5, 0.7 + 300 * t);
    samples.emplace_back(static_cast<float>(light.real() + 0.05 * test::normal(random)),
                         static_cast<float>(light.imag() + 0.05 * test::normal(random)));
  }
  Recorded capture(samples, Hertz(50e3), true);
  SampledLine line(capture, {.carrier = {}, .baud = Hertz(600)});
  EXPECT_EQ(bytes_of(line, 600), sent_bytes(sent, 600));
}

TEST(SampledLine, ReadsAVoltageAsItIs) {
  Random random(56);
  for (const double baud : {600.0, 9600.0}) {
    const LogicTrace sent = test::bent_line(random, 4, baud, {});
    Samples samples;
    for (double i = 0; i / 250e3 < sent.end().value; ++i)
      samples.emplace_back(static_cast<float>(3.3 * sent.level_at(Seconds(i / 250e3)) +
                                              0.05 * test::normal(random)));
    Recorded capture(samples, Hertz(250e3), false);
    SampledLine line(capture, {});
    EXPECT_EQ(line.carrier(), Hertz(0));
    EXPECT_EQ(bytes_of(line, baud), sent_bytes(sent, baud));
  }
}

TEST(SampledLine, SilenceAndNothingGiveNoCharacters) {
  Random random(57);
  Samples flat(300'000, 1.0F), none;
  for (const Samples& samples : {flat, none})
    for (const bool is_complex : {true, false}) {
      Recorded capture(samples, Hertz(500e3), is_complex);
      SampledLine line(capture, {});
      EXPECT_FALSE(line.next());
      EXPECT_EQ(line.known_until().value, static_cast<double>(samples.size()) / 500e3);
    }
}

}  // namespace
}  // namespace sim
