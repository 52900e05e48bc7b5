// The light of a trace as samples: what WAV and SigMF keep of it, and what they say of it.
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "program.hpp"
#include "scenarios.hpp"
#include "sim/capture/capture_file.hpp"
#include "sim/trace/trace_file.hpp"

namespace {

using nlohmann::json;

class LightTrace : public CommandLine {
 protected:
  LightTrace() {
    const auto scenario = sim::loaded("", {"simulation.warmup_messages=1", "receiver.range_m=0.5",
                                           "simulation.sample_rate_hz=300000"});
    traced_ = sim::trace_trial(sim::point_scenario(scenario, {}), 3);
    traced_.origin = {.program = {"cosys-sim", "0.1.0", "abc"},
                      .scenario_toml = "title = 'Licht'",
                      .seed = 18446744073709551615U,
                      .point = 4,
                      .trial = 3};
  }

  std::vector<std::complex<float>> samples(const std::string& file) const {
    const sim::Capture capture = sim::open_capture(path(file), {});
    std::vector<std::complex<float>> samples(traced_.taps.irradiance.size() + 10);
    samples.resize(capture.samples->read(samples));
    return samples;
  }

  json meta(const std::string& file) const { return json::parse(content(path(file))); }

  sim::TracedTrial traced_;
};

TEST_F(LightTrace, WavKeepsEveryBitAndSaysItsScale) {
  for (const float gain : {1.0F, 1000.0F, 0.0F}) {
    for (float& sample : traced_.taps.irradiance) sample *= gain;
    sim::write_trace(path("t.wav"), traced_);
    const auto back = samples("t.wav");
    const std::string head = content(path("t.wav")).substr(0, 1000), said = "full scale is ";
    ASSERT_NE(head.find(said), std::string::npos);
    const float scale = std::stof(head.substr(head.find(said) + said.size()));
    ASSERT_EQ(back.size(), traced_.taps.irradiance.size());
    float peak = 0;
    for (std::size_t i = 0; i < back.size(); ++i) {
      ASSERT_EQ(back[i].real() * scale, traced_.taps.irradiance[i]);
      peak = std::max(peak, std::abs(back[i].real()));
    }
    EXPECT_LT(peak, 1);
    EXPECT_GE(peak, gain == 0 ? 0 : 0.5);
  }
}

TEST_F(LightTrace, WavOfEqualTracesIsEqual) {
  sim::write_trace(path("t.wav"), traced_);
  ::sleep(1);  // libsndfile would put the second at which a float file was made into it
  sim::write_trace(path("u.wav"), traced_);
  EXPECT_TRUE(content(path("t.wav")) == content(path("u.wav")));
}

TEST_F(LightTrace, SigmfDataIsTheLightAndItsBaseband) {
  sim::write_trace(path("t.sigmf-meta"), traced_);
  const std::string data = content(path("t.sigmf-data"));
  ASSERT_EQ(data.size(), traced_.taps.irradiance.size() * sizeof(float));
  EXPECT_EQ(std::memcmp(data.data(), traced_.taps.irradiance.data(), data.size()), 0);
  double on = 0, off = 0, n_on = 0, n_off = 0;  // amplitudes in and out of light
  const auto baseband = samples("t-baseband.sigmf-meta");
  EXPECT_EQ(baseband.size(), (traced_.taps.irradiance.size() + 5) / 6);
  for (std::size_t i = 0; i < baseband.size(); ++i) {
    const dsp::Seconds at(static_cast<double>(i) / 50e3), near(3e-4);
    if (traced_.tx.level_at(at - near) != traced_.tx.level_at(at + near)) continue;
    const bool dark = traced_.tx.level_at(at);
    (dark ? off : on) += static_cast<double>(std::abs(baseband[i]));
    ++(dark ? n_off : n_on);
  }
  // The fundamental of a square wave of half duty has 2 / pi of its height, which is the peak.
  const float peak = *std::ranges::max_element(traced_.taps.irradiance);
  EXPECT_NEAR(on / n_on, 2 / M_PI * static_cast<double>(peak), 0.05 * static_cast<double>(peak));
  EXPECT_LT(off / n_off, 0.02 * on / n_on);
}

TEST_F(LightTrace, SigmfSaysWhatIsInItsData) {
  sim::write_trace(path("t.sigmf-meta"), traced_);
  for (const std::string name : {"t", "t-baseband"}) {
    const json global = meta(name + ".sigmf-meta").at("global");
    EXPECT_EQ(global.at("core:sha512").get<std::string>() + "  " + name + ".sigmf-data\n",
              tool("sha512sum", {name + ".sigmf-data"}));
    EXPECT_EQ(global.at("cosys:seed"), 18446744073709551615U);
    EXPECT_EQ(global.at("cosys:scenario_toml"), "title = 'Licht'");
  }
  const json real = meta("t.sigmf-meta"), complex = meta("t-baseband.sigmf-meta");
  EXPECT_EQ(real.at("global").at("core:datatype"), "rf32_le");
  EXPECT_EQ(real.at("global").at("core:sample_rate"), 300e3);
  EXPECT_EQ(complex.at("global").at("core:datatype"), "cf32_le");
  EXPECT_EQ(complex.at("global").at("core:sample_rate"), 50e3);
  EXPECT_NEAR(complex.at("captures").at(0).at("core:frequency").get<double>(), 59e3, 100);
}

TEST_F(LightTrace, SigmfAnnotatesEachCharacter) {
  sim::write_trace(path("t.sigmf-meta"), traced_);
  for (const std::string name : {"t.sigmf-meta", "t-baseband.sigmf-meta"}) {
    const json file = meta(name);
    const double rate = file.at("global").at("core:sample_rate");
    std::string text;
    for (const json& character : file.at("annotations")) {
      text += character.at("core:label").get<std::string>();
      const double start = character.at("core:sample_start").get<double>() / rate;
      const double length = character.at("core:sample_count").get<double>() / rate;
      EXPECT_NEAR(length, 10 / 600.0, 1e-4);
      EXPECT_TRUE(traced_.tx.level_at(dsp::Seconds(start - 2 / rate)));  // light begins there
      EXPECT_FALSE(traced_.tx.level_at(dsp::Seconds(start + 2 / rate)));
      EXPECT_LT(character.at("core:freq_lower_edge"), traced_.carrier.value);
      EXPECT_GT(character.at("core:freq_upper_edge"), traced_.carrier.value);
    }
    EXPECT_EQ(text, "IND 011111 OK 46\\x0aIND 011111 OK 46\\x0a");
  }
}

}  // namespace
