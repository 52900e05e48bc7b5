#pragma once
// Logic samples as logic analysers store them: a unit of some bytes a sample, bit 0 of its first
// byte being the first channel. Raw files (.bin) have no header; sigrok's `binary` output has a
// byte a sample for up to eight channels, two for up to sixteen, and so on.
#include <array>
#include <cstdint>
#include <functional>
#include <istream>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/capture/logic_capture.hpp"

namespace sim {

/// Levels of wires, one sample after the other.
class LogicSamples : public LogicCapture {
 public:
  /// The next bytes, any number; none at the end.
  using Blocks = std::function<std::span<const std::uint8_t>()>;

  /// The name of each bit's wire, for up to 64; bits without a name are none. A unit has room for
  /// all, and may have more.
  LogicSamples(const std::vector<std::string>& bits, std::size_t unit_bytes, dsp::Hertz sample_rate,
               Blocks blocks);

  const std::vector<std::string>& wires() const override { return wires_; }
  std::optional<WireLevel> next() override;
  /// To the end of the last sample. Bytes of a unit that was cut short are none.
  dsp::Seconds now() const override { return at(samples_); }
  dsp::Seconds resolution() const override { return dsp::period(sample_rate_); }

 private:
  dsp::Seconds at(std::uint64_t sample) const;
  bool read_change();
  bool read_unit(std::uint64_t& unit);
  void skip_equal();

  std::vector<std::string> wires_;
  std::array<std::size_t, 64> wire_of_{};  // by the bit
  std::uint64_t wired_ = 0;                // bits that have one
  std::size_t unit_bytes_;
  dsp::Hertz sample_rate_;
  Blocks blocks_;
  std::span<const std::uint8_t> block_;
  std::uint64_t samples_ = 0;  // read
  std::uint64_t unit_ = 0;     // the last one
  std::uint64_t changed_ = 0;  // bits of it that were not given yet
  bool first_ = true;          // they are those of the first sample
};

/// What a raw file does not say of itself.
struct RawLayout {
  std::optional<dsp::Hertz> sample_rate;
  std::size_t unit_bytes = 1;  // 1 to 8
};

/// Channels are named 0, 1, ... Throws Failure(bad_input) without a sample rate.
/// Of a file's beginning: whether it looks like that many bytes a sample, of which some never
/// change, rather than one. Nothing where it does not.
std::optional<std::size_t> bytes_it_looks_like(std::string_view beginning);

std::unique_ptr<LogicCapture> open_raw(std::istream& in, const std::string& file,
                                       const RawLayout& layout);

}  // namespace sim
