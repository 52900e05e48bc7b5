#include "sim/trace/wav_write.hpp"

#include <fmt/format.h>
#include <sndfile.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string_view>

#include "sim/trace/wav_image.hpp"

namespace sim {
namespace {

constexpr const char* software = "cosys-sim";

float full_scale_of(const std::vector<float>& samples) {
  float peak = 0;
  for (const float sample : samples) peak = std::max(peak, std::abs(sample));
  int exponent = 0;
  std::frexp(peak, &exponent);
  return std::ldexp(1.0F, exponent);
}

}  // namespace

std::string trace_as_wav(const TracedTrial& trial) {
  std::vector<float> samples = trial.taps.irradiance;
  const float full_scale = full_scale_of(samples);
  for (float& sample : samples) sample /= full_scale;
  return wav_image(
      samples, trial.sample_rate,
      {software, fmt::format("irradiance at the receiver, full scale is {} mW/m2", full_scale)});
}

bool is_wav_trace(const std::filesystem::path& path) {
  SF_INFO info{};
  const std::unique_ptr<SNDFILE, decltype(&sf_close)> file(sf_open(path.c_str(), SFM_READ, &info),
                                                           sf_close);
  const char* by = file ? sf_get_string(file.get(), SF_STR_SOFTWARE) : nullptr;
  return by != nullptr && std::string_view(by).starts_with(software);
}

}  // namespace sim
