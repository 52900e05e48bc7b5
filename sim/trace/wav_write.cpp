#include "sim/trace/wav_write.hpp"

#include <fmt/format.h>
#include <sndfile.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string_view>

#include "sim/failure.hpp"

namespace sim {
namespace {

constexpr const char* software = "cosys-sim";
constexpr std::size_t most_samples = (std::size_t{1} << 30U) - 1024;  // of 4 bytes, and a header

using SoundFile = std::unique_ptr<SNDFILE, decltype(&sf_close)>;

/// A file in memory, as libsndfile sees one.
struct Image {
  std::string bytes;
  std::size_t at = 0;
};

Image& image_of(void* user) { return *static_cast<Image*>(user); }

sf_count_t length(void* user) { return static_cast<sf_count_t>(image_of(user).bytes.size()); }
sf_count_t tell(void* user) { return static_cast<sf_count_t>(image_of(user).at); }

sf_count_t seek(sf_count_t offset, int whence, void* user) {
  const sf_count_t base = whence == SEEK_SET ? 0 : whence == SEEK_CUR ? tell(user) : length(user);
  image_of(user).at = static_cast<std::size_t>(base + offset);
  return tell(user);
}

sf_count_t read(void* to, sf_count_t count, void* user) {
  Image& image = image_of(user);
  const std::string_view rest =
      std::string_view(image.bytes).substr(std::min(image.at, image.bytes.size()));
  const std::size_t n = rest.copy(static_cast<char*>(to), static_cast<std::size_t>(count));
  image.at += n;
  return static_cast<sf_count_t>(n);
}

sf_count_t write(const void* from, sf_count_t count, void* user) {
  Image& image = image_of(user);
  const auto size = static_cast<std::size_t>(count);
  image.bytes.resize(std::max(image.bytes.size(), image.at + size));
  std::copy_n(static_cast<const char*>(from), size,
              image.bytes.begin() + static_cast<std::ptrdiff_t>(image.at));
  image.at += size;
  return count;
}

Failure unwritten(const std::string& why) {
  return {ExitCode::environment, "the WAV file cannot be made (" + why + ") trace into .h5"};
}

SoundFile open_image(Image& image, dsp::Hertz rate) {
  SF_VIRTUAL_IO in_memory{length, seek, read, write, tell};
  SF_INFO info{};
  info.samplerate = static_cast<int>(std::lround(rate.value));
  info.channels = 1;
  info.format = SF_FORMAT_WAV | SF_FORMAT_FLOAT;
  SoundFile file(sf_open_virtual(&in_memory, SFM_WRITE, &info, &image), sf_close);
  if (!file) throw unwritten(sf_strerror(nullptr));
  sf_command(file.get(), SFC_SET_ADD_PEAK_CHUNK, nullptr, SF_FALSE);  // it has the time of day
  return file;
}

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
  if (samples.size() > most_samples) throw unwritten("it would be longer than 4 GiB");
  const float full_scale = full_scale_of(samples);
  for (float& sample : samples) sample /= full_scale;
  Image image;
  SoundFile file = open_image(image, trial.sample_rate);
  const std::string comment =
      fmt::format("irradiance at the receiver, full scale is {} mW/m2", full_scale);
  sf_set_string(file.get(), SF_STR_SOFTWARE, software);
  sf_set_string(file.get(), SF_STR_COMMENT, comment.c_str());
  const auto count = static_cast<sf_count_t>(samples.size());
  const bool whole = sf_write_float(file.get(), samples.data(), count) == count;
  if (sf_close(file.release()) != 0 || !whole) throw unwritten("libsndfile gave up");
  return std::move(image.bytes);
}

bool is_wav_trace(const std::filesystem::path& path) {
  SF_INFO info{};
  const SoundFile file(sf_open(path.c_str(), SFM_READ, &info), sf_close);
  const char* by = file ? sf_get_string(file.get(), SF_STR_SOFTWARE) : nullptr;
  return by != nullptr && std::string_view(by).starts_with(software);
}

}  // namespace sim
