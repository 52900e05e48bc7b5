#include "sim/trace/wav_image.hpp"

#include <sndfile.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string_view>
#include <utility>

#include "sim/failure.hpp"

namespace sim {
namespace {

constexpr std::size_t most_bytes = (std::size_t{1} << 32U) - 4096;  // behind a header

using SoundFile = std::unique_ptr<SNDFILE, decltype(&sf_close)>;

/// A file in memory, as libsndfile sees one.
struct Image {
  std::string bytes;
  std::size_t at = 0;
};

Image& own(void* user) { return *static_cast<Image*>(user); }

sf_count_t length(void* user) { return static_cast<sf_count_t>(own(user).bytes.size()); }
sf_count_t tell(void* user) { return static_cast<sf_count_t>(own(user).at); }

sf_count_t seek(sf_count_t offset, int whence, void* user) {
  const sf_count_t base = whence == SEEK_SET ? 0 : whence == SEEK_CUR ? tell(user) : length(user);
  own(user).at = static_cast<std::size_t>(base + offset);
  return tell(user);
}

sf_count_t read(void* to, sf_count_t count, void* user) {
  Image& image = own(user);
  const std::string_view rest =
      std::string_view(image.bytes).substr(std::min(image.at, image.bytes.size()));
  const std::size_t n = rest.copy(static_cast<char*>(to), static_cast<std::size_t>(count));
  image.at += n;
  return static_cast<sf_count_t>(n);
}

sf_count_t write(const void* from, sf_count_t count, void* user) {
  Image& image = own(user);
  const auto size = static_cast<std::size_t>(count);
  image.bytes.resize(std::max(image.bytes.size(), image.at + size));
  std::copy_n(static_cast<const char*>(from), size,
              image.bytes.begin() + static_cast<std::ptrdiff_t>(image.at));
  image.at += size;
  return count;
}

[[noreturn]] void fail(const std::string& why) {
  throw Failure(ExitCode::environment,
                "the WAV file cannot be made (" + why + ") use another format");
}

SoundFile open_image(Image& image, dsp::Hertz rate, int sample_format) {
  SF_VIRTUAL_IO in_memory{length, seek, read, write, tell};
  SF_INFO info{};
  info.samplerate = static_cast<int>(std::lround(rate.value));
  info.channels = 1;
  info.format = SF_FORMAT_WAV | sample_format;
  SoundFile file(sf_open_virtual(&in_memory, SFM_WRITE, &info, &image), sf_close);
  if (!file) fail(sf_strerror(nullptr));
  sf_command(file.get(), SFC_SET_ADD_PEAK_CHUNK, nullptr, SF_FALSE);  // it has the time of day
  return file;
}

/// `put` writes all samples by libsndfile's function of their type, and returns how many.
template <class Sample, class Put>
std::string image_of(std::span<const Sample> samples, dsp::Hertz rate, int sample_format,
                     const Put& put) {
  if (samples.size_bytes() > most_bytes) fail("it would be longer than 4 GiB");
  Image image;
  SoundFile file = open_image(image, rate, sample_format);
  const auto count = static_cast<sf_count_t>(samples.size());
  const bool whole = put(file.get(), samples.data(), count) == count;
  if (sf_close(file.release()) != 0 || !whole) fail("libsndfile gave up");
  return std::move(image.bytes);
}

void say(SNDFILE* file, int where, const std::string& text) {
  if (!text.empty()) sf_set_string(file, where, text.c_str());
}

}  // namespace

std::string wav_image(std::span<const float> samples, dsp::Hertz rate, const WavWords& words) {
  return image_of(samples, rate, SF_FORMAT_FLOAT,
                  [&](SNDFILE* file, const float* first, sf_count_t count) {
                    say(file, SF_STR_SOFTWARE, words.software);
                    say(file, SF_STR_COMMENT, words.comment);
                    return sf_write_float(file, first, count);
                  });
}

std::string wav_image(std::span<const short> samples, dsp::Hertz rate) {
  return image_of(samples, rate, SF_FORMAT_PCM_16, sf_write_short);
}

}  // namespace sim
