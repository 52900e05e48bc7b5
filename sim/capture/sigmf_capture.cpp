#include "sim/capture/sigmf_capture.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <map>

#include <nlohmann/json.hpp>
#include <utility>

#include "sim/capture/text_lines.hpp"
#include "sim/failure.hpp"
#include "sim/text/number_text.hpp"
#include "sim/text/text_file.hpp"

namespace sim {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_meta = 64 * mebibyte, most_channels = 64;

template <class Number>
double number_in(const unsigned char* bytes) {
  Number number;
  std::memcpy(&number, bytes, sizeof(number));
  return static_cast<double>(number);
}

struct NumberType {
  std::size_t bytes;
  double (*read)(const unsigned char* bytes);  // in the machine's byte order
};

/// What "core:datatype" names behind its r or c.
const std::map<std::string, NumberType, std::less<>> number_types = {
    {"f32", {4, number_in<float>}},         {"f64", {8, number_in<double>}},
    {"i32", {4, number_in<std::int32_t>}},  {"i16", {2, number_in<std::int16_t>}},
    {"u32", {4, number_in<std::uint32_t>}}, {"u16", {2, number_in<std::uint16_t>}},
    {"i8", {1, number_in<std::int8_t>}},    {"u8", {1, number_in<std::uint8_t>}}};

struct Layout {
  bool is_complex = false, swapped = false;
  NumberType number{};
  std::size_t channels = 1;
  dsp::Hertz sample_rate;

  std::size_t numbers_a_sample() const { return is_complex ? 2 : 1; }
  std::size_t frame_bytes() const { return channels * numbers_a_sample() * number.bytes; }
};

Failure unreadable_recording(const fs::path& meta, const std::string& why) {
  return bad_input("cannot read " + meta.string(), why, "give a SigMF recording, version 1");
}

void set_type(const fs::path& meta, const std::string& type, Layout& layout) {
  const bool big = type.ends_with("_be");
  const bool ordered = big || type.ends_with("_le");
  const std::string name = type.substr(0, type.size() - (ordered ? 3 : 0));
  const auto found = number_types.find(std::string_view(name).substr(name.empty() ? 0 : 1));
  if (found == number_types.end() || (name[0] != 'c' && name[0] != 'r'))
    throw unreadable_recording(meta, "core:datatype '" + shown(type) + "' is not one of SigMF");
  layout.is_complex = name[0] == 'c';
  layout.number = found->second;
  layout.swapped = big != (std::endian::native == std::endian::big);
}

Layout layout_of(const fs::path& meta, const std::optional<dsp::Hertz>& told_rate) {
  Layout layout;
  try {
    const auto json = nlohmann::json::parse(read_text_file(meta, "SigMF metadata", longest_meta));
    const auto& global = json.at("global");
    set_type(meta, global.at("core:datatype").get<std::string>(), layout);
    layout.channels = global.value("core:num_channels", std::size_t{1});
    layout.sample_rate =
        told_rate ? *told_rate : dsp::Hertz(global.at("core:sample_rate").get<double>());
  } catch (const nlohmann::json::parse_error& error) {
    throw unreadable_recording(meta, fmt::format("no JSON from byte {} on", error.byte));
  } catch (const nlohmann::json::exception&) {
    throw unreadable_recording(
        meta,
        "its core:datatype, core:sample_rate or core:num_channels is not there, "
        "or of another type");
  }
  if (!is_sample_rate(layout.sample_rate))
    throw unreadable_recording(meta, "core:sample_rate is not from 1 Hz to 1 THz");
  if (layout.channels < 1 || layout.channels > most_channels)
    throw unreadable_recording(meta, "core:num_channels is not from 1 to 64");
  return layout;
}

class SigmfCapture : public SampleCapture {
 public:
  SigmfCapture(const fs::path& meta, const Layout& layout, std::size_t channel)
      : meta_(meta),
        in_(fs::path(meta).replace_extension(".sigmf-data"), "SigMF data"),
        layout_(layout),
        channel_(channel),
        frame_(layout.frame_bytes()) {}

  dsp::Hertz sample_rate() const override { return layout_.sample_rate; }
  bool is_complex() const override { return layout_.is_complex; }

  std::size_t read(std::span<std::complex<float>> to) override {
    std::size_t count = 0;
    for (; count < to.size() && read_frame(); ++count) {
      const std::size_t first = channel_ * layout_.numbers_a_sample();
      const float real = number(first), imaginary = layout_.is_complex ? number(first + 1) : 0;
      if (!std::isfinite(real) || !std::isfinite(imaginary))
        throw unreadable_recording(meta_, "a sample is not finite");
      to[count] = {real, imaginary};
    }
    return count;
  }

 private:
  bool read_frame() {
    const auto size = static_cast<std::streamsize>(frame_.size());
    return in_.rdbuf()->sgetn(reinterpret_cast<char*>(frame_.data()), size) == size;
  }

  float number(std::size_t index) const {
    std::array<unsigned char, 8> bytes{};
    const auto own = std::span(frame_).subspan(index * layout_.number.bytes, layout_.number.bytes);
    std::ranges::copy(own, bytes.begin());
    if (layout_.swapped) std::reverse(bytes.data(), bytes.data() + own.size());
    return static_cast<float>(layout_.number.read(bytes.data()));
  }

  fs::path meta_;
  InputStream in_;
  Layout layout_;
  std::size_t channel_;
  std::vector<unsigned char> frame_;
};

}  // namespace

std::unique_ptr<SampleCapture> open_sigmf(const fs::path& meta, const CaptureSettings& settings) {
  const Layout layout = layout_of(meta, settings.sample_rate);
  const double channel = settings.wire.empty() ? 0 : parse_number(settings.wire).value_or(-1);
  if (channel < 0 || channel >= static_cast<double>(layout.channels) ||
      channel != std::floor(channel))
    throw bad_input("--channel " + settings.wire + " is not in " + meta.string(),
                    "channels of a SigMF recording are numbers from 0 on",
                    "use one up to " + std::to_string(layout.channels - 1));
  return std::make_unique<SigmfCapture>(meta, layout, static_cast<std::size_t>(channel));
}

}  // namespace sim
