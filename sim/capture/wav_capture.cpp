#include "sim/capture/wav_capture.hpp"

#include <fmt/format.h>
#include <sndfile.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "sim/failure.hpp"
#include "sim/text/existing_file.hpp"
#include "sim/text/number_text.hpp"

namespace sim {
namespace {

constexpr const char* give = "give a WAV file of numbers, as sox or an oscilloscope writes it";
constexpr std::size_t frames_a_read = 8192;

/// Throws where the file is shorter than its head says. A writer into a pipe, which cannot know,
/// says nothing or as much as there can be.
void refuse_if_cut(const std::filesystem::path& path) {
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  if (error) return;  // a pipe
  const std::string head = beginning_of(path, 8);
  if (head.size() < 8 || !head.starts_with("RIFF")) return;
  std::uint32_t said = 0;
  for (std::size_t i = 8; i-- > 4;) said = said << 8U | static_cast<std::uint8_t>(head[i]);
  constexpr std::uint32_t unknown_from = 0x7fff'0000;
  if (said < unknown_from && std::uint64_t{said} + 8 > size)
    throw bad_input("cannot decode " + path.string(),
                    fmt::format("{} of its {} bytes are there", size, std::uint64_t{said} + 8),
                    "copy it again");
}

class WavCapture : public SampleCapture {
 public:
  WavCapture(const std::filesystem::path& path, const std::string& channel) : name_(path.string()) {
    refuse_if_cut(path);
    file_.reset(sf_open(path.c_str(), SFM_READ, &info_));
    if (file_ == nullptr) throw bad_input("cannot read " + name_, sf_strerror(nullptr), give);
    channel_ = number_of(channel);
    frames_.resize(frames_a_read * channels());
  }

  dsp::Hertz sample_rate() const override { return dsp::Hertz(info_.samplerate); }
  bool is_complex() const override { return false; }

  std::size_t read(std::span<std::complex<float>> to) override {
    std::size_t count = 0;
    while (count < to.size()) {
      const std::size_t n = read_frames(std::min(frames_a_read, to.size() - count));
      if (n == 0) break;
      for (std::size_t i = 0; i < n; ++i) to[count++] = frames_[i * channels() + channel_];
    }
    return count;
  }

 private:
  std::size_t channels() const { return static_cast<std::size_t>(info_.channels); }

  std::size_t number_of(const std::string& channel) const {
    const double number = channel.empty() ? 0 : parse_number(channel).value_or(-1);
    if (number >= 0 && number < info_.channels && number == std::floor(number))
      return static_cast<std::size_t>(number);
    throw bad_input(fmt::format("--channel {} is not in {}", channel, name_),
                    "channels of a WAV file are numbers from 0 on",
                    fmt::format("use one up to {}", info_.channels - 1));
  }

  std::size_t read_frames(std::size_t count) {
    const sf_count_t n =
        sf_readf_float(file_.get(), frames_.data(), static_cast<sf_count_t>(count));
    const auto values = std::span(frames_).first(static_cast<std::size_t>(n) * channels());
    if (!std::ranges::all_of(values, [](float value) { return std::isfinite(value); }))
      throw bad_input("cannot read " + name_, "a sample is not finite", give);
    return static_cast<std::size_t>(n);
  }

  std::string name_;
  std::unique_ptr<SNDFILE, decltype(&sf_close)> file_{nullptr, sf_close};
  SF_INFO info_{};
  std::size_t channel_ = 0;
  std::vector<float> frames_;
};

}  // namespace

std::unique_ptr<SampleCapture> open_wav(const std::filesystem::path& path,
                                        const std::string& channel) {
  return std::make_unique<WavCapture>(path, channel);
}

}  // namespace sim
