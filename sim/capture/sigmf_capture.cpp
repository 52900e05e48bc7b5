#include "sim/capture/sigmf_capture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/capture/sample_choice.hpp"
#include "sim/capture/sigmf_meta.hpp"
#include "sim/failure.hpp"

namespace sim {
namespace {

namespace fs = std::filesystem;

/// The bytes of a recording that are samples.
class SigmfData {
 public:
  SigmfData(const fs::path& meta, const SigmfLayout& layout)
      : in_(layout.data, "SigMF data"), segments_(layout.segments) {
    if (layout.trailing_bytes == 0) return;
    std::error_code error;
    const std::uint64_t size = fs::file_size(layout.data, error);
    if (error) throw unreadable_recording(meta, "its core:trailing_bytes ask for a file of a size");
    left_ = size - std::min<std::uint64_t>(size, layout.trailing_bytes);
  }

  /// Whether there is another frame of all channels.
  bool read(std::span<unsigned char> frame) {
    for (; next_ < segments_.size() && segments_[next_].first_sample == frames_; ++next_)
      if (!skip(segments_[next_].header_bytes)) return false;
    ++frames_;
    return take(frame.data(), frame.size());
  }

 private:
  bool skip(std::uint64_t bytes) {
    std::array<unsigned char, 4096> skipped;
    while (bytes > 0) {
      const std::size_t size = std::min<std::uint64_t>(bytes, skipped.size());
      if (!take(skipped.data(), size)) return false;
      bytes -= size;
    }
    return true;
  }

  bool take(unsigned char* to, std::size_t size) {
    if (size > left_) return false;
    left_ -= size;
    const auto wanted = static_cast<std::streamsize>(size);
    return in_.rdbuf()->sgetn(reinterpret_cast<char*>(to), wanted) == wanted;
  }

  InputStream in_;
  std::vector<SigmfSegment> segments_;
  std::size_t next_ = 0;
  std::uint64_t frames_ = 0, left_ = std::numeric_limits<std::uint64_t>::max();
};

class SigmfCapture : public SampleCapture {
 public:
  SigmfCapture(const fs::path& meta, SigmfLayout layout, std::size_t channel)
      : meta_(meta),
        data_(meta, layout),
        layout_(std::move(layout)),
        channel_(channel),
        frame_(layout_.frame_bytes()) {}

  dsp::Hertz sample_rate() const override { return layout_.sample_rate; }
  bool is_complex() const override { return layout_.is_complex; }

  std::size_t read(std::span<std::complex<float>> to) override {
    std::size_t count = 0;
    for (; count < to.size() && data_.read(frame_); ++count) {
      const std::size_t first = channel_ * layout_.numbers_a_sample();
      const float real = number(first), imaginary = layout_.is_complex ? number(first + 1) : 0;
      if (!std::isfinite(real) || !std::isfinite(imaginary))
        throw unreadable_recording(meta_, "a sample is not finite");
      to[count] = {real, imaginary};
    }
    return count;
  }

 private:
  float number(std::size_t index) const {
    std::array<unsigned char, 8> bytes{};
    const auto own = std::span(frame_).subspan(index * layout_.number.bytes, layout_.number.bytes);
    std::ranges::copy(own, bytes.begin());
    if (layout_.swapped) std::reverse(bytes.data(), bytes.data() + own.size());
    return static_cast<float>(layout_.number.read(bytes.data()) - layout_.number.middle);
  }

  fs::path meta_;
  SigmfData data_;
  SigmfLayout layout_;
  std::size_t channel_;
  std::vector<unsigned char> frame_;
};

}  // namespace

void open_sigmf(const fs::path& meta, const CaptureSettings& settings, Capture& capture) {
  const SigmfLayout layout = read_sigmf_meta(meta, settings);
  SampleChannels channels;
  for (std::size_t i = 1; i <= layout.channels; ++i) channels.names.push_back(std::to_string(i));
  channels.opens_again = fs::is_regular_file(layout.data);
  channels.open = [&](std::size_t channel) {
    return std::make_unique<SigmfCapture>(meta, layout, channel);
  };
  take_samples(meta.string(), channels, settings, capture);
}

}  // namespace sim
