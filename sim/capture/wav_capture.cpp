#include "sim/capture/wav_capture.hpp"

#include <fmt/format.h>
#include <sndfile.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "sim/capture/sample_choice.hpp"
#include "sim/failure.hpp"
#include "sim/text/existing_file.hpp"

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
  WavCapture(const std::filesystem::path& path, std::size_t channel)
      : name_(path.string()), channel_(channel) {
    refuse_if_cut(path);
    file_.reset(sf_open(path.c_str(), SFM_READ, &info_));
    if (file_ == nullptr) throw bad_input("cannot read " + name_, sf_strerror(nullptr), give);
    refuse_if_empty(path);
    frames_.resize(frames_a_read * channels());
  }

  void take(std::size_t channel) { channel_ = channel; }
  std::size_t channels() const { return static_cast<std::size_t>(info_.channels); }

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
  /// A recorder that lost its power has not written how much there is.
  void refuse_if_empty(const std::filesystem::path& path) const {
    constexpr std::uintmax_t largest_head = 4096;
    std::error_code error;
    const auto size = std::filesystem::file_size(path, error);
    if (!error && info_.frames == 0 && size > largest_head)
      throw bad_input("cannot decode " + name_,
                      fmt::format("its head says that no samples are there, of {} bytes", size),
                      "mend it, as sox --ignore-length does");
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
  std::size_t channel_;
  std::unique_ptr<SNDFILE, decltype(&sf_close)> file_{nullptr, sf_close};
  SF_INFO info_{};
  std::vector<float> frames_;
};

}  // namespace

void open_wav(const std::filesystem::path& path, const CaptureSettings& settings,
              Capture& capture) {
  auto first = std::make_unique<WavCapture>(path, 0);
  SampleChannels channels;
  for (std::size_t i = 1; i <= first->channels(); ++i) channels.names.push_back(std::to_string(i));
  channels.opens_again = std::filesystem::is_regular_file(path);
  channels.open = [&](std::size_t channel) -> std::unique_ptr<SampleCapture> {
    if (!channels.opens_again || channels.names.size() == 1) {
      first->take(channel);
      return std::move(first);
    }
    return std::make_unique<WavCapture>(path, channel);
  };
  take_samples(path.string(), channels, settings, capture);
}

}  // namespace sim
