#include "sim/capture/raw_capture.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "sim/failure.hpp"

namespace sim {

using dsp::Seconds;

LogicSamples::LogicSamples(const std::vector<std::string>& bits, std::size_t unit_bytes,
                           dsp::Hertz sample_rate, Blocks blocks)
    : unit_bytes_(unit_bytes), sample_rate_(sample_rate), blocks_(std::move(blocks)) {
  for (std::size_t bit = 0; bit < bits.size(); ++bit) {
    if (bits[bit].empty()) continue;
    wire_of_[bit] = wires_.size();
    wired_ |= std::uint64_t{1} << bit;
    wires_.push_back(bits[bit]);
  }
}

Seconds LogicSamples::at(std::uint64_t sample) const {
  return Seconds(static_cast<double>(sample) / sample_rate_.value);
}

bool LogicSamples::read_unit(std::uint64_t& unit) {
  unit = 0;
  for (std::size_t i = 0; i < unit_bytes_; ++i) {
    if (block_.empty()) block_ = blocks_();
    if (block_.empty()) return false;
    if (i < sizeof(unit)) unit |= std::uint64_t{block_.front()} << (8 * i);
    block_ = block_.subspan(1);
  }
  ++samples_;
  return true;
}

/// Most samples are as the one before: those of one byte are passed over in one go.
void LogicSamples::skip_equal() {
  if (unit_bytes_ != 1) return;
  const auto equal = [&](std::uint8_t byte) { return byte == unit_; };
  const auto other = std::ranges::find_if_not(block_, equal);
  const auto count = static_cast<std::size_t>(other - block_.begin());
  samples_ += count;
  block_ = block_.subspan(count);
}

bool LogicSamples::read_change() {
  first_ = samples_ == 0;
  std::uint64_t unit = 0;
  while (read_unit(unit)) {
    changed_ = (first_ ? ~std::uint64_t{0} : unit ^ unit_) & wired_;
    unit_ = unit;
    if (changed_ != 0) return true;
    skip_equal();
  }
  return false;
}

std::optional<WireLevel> LogicSamples::next() {
  if (changed_ == 0 && !read_change()) return std::nullopt;
  const auto bit = static_cast<std::size_t>(std::countr_zero(changed_));
  changed_ &= changed_ - 1;
  return WireLevel{wire_of_[bit], at(samples_ - 1), ((unit_ >> bit) & 1U) != 0, first_};
}

std::optional<std::size_t> bytes_it_looks_like(std::string_view beginning) {
  constexpr std::size_t longest_sample = 8, fewest_bytes = 64;
  if (beginning.size() < fewest_bytes) return std::nullopt;
  const auto changes = [&](std::size_t distance) {  // of bytes so far apart, in parts of all
    std::size_t count = 0;
    for (std::size_t i = longest_sample; i < beginning.size(); ++i)
      count += beginning[i] != beginning[i - distance];
    return static_cast<double>(count) / static_cast<double>(beginning.size() - longest_sample);
  };
  const double from_byte_to_byte = changes(1);
  for (const std::size_t bytes : {2U, 4U, 8U})
    if (from_byte_to_byte > 0.2 && changes(bytes) < from_byte_to_byte / 10) return bytes;
  return std::nullopt;
}

std::unique_ptr<LogicCapture> open_raw(std::istream& in, const std::string& file,
                                       const RawLayout& layout) {
  if (!layout.sample_rate)
    throw bad_input(file + " has no sample rate", "raw samples do not say theirs",
                    "say --sample-rate");
  auto chunk = std::make_shared<std::array<std::uint8_t, 65536>>();
  const auto blocks = [&in, chunk]() -> std::span<const std::uint8_t> {
    constexpr std::streamsize size = 65536;
    const auto n = in.rdbuf()->sgetn(reinterpret_cast<char*>(chunk->data()), size);
    return std::span(*chunk).first(static_cast<std::size_t>(n));
  };
  std::vector<std::string> wires;
  for (std::size_t channel = 0; channel < 8 * layout.unit_bytes; ++channel)
    wires.push_back(std::to_string(channel));
  return std::make_unique<LogicSamples>(wires, layout.unit_bytes, *layout.sample_rate, blocks);
}

}  // namespace sim
