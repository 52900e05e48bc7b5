#include "sim/capture/pulse_capture.hpp"

#include <array>
#include <charconv>
#include <cstdint>
#include <utility>

#include "sim/capture/text_lines.hpp"

namespace sim {
namespace {

using dsp::Seconds;

// The idle time before the first pulse, which the text does not have: room for a whole character at
// 300 Bd, so that the pulse begins one.
constexpr Seconds lead(0.04);

class PulseCapture : public LogicCapture {
 public:
  PulseCapture(std::istream& in, std::string file)
      : lines_(in, std::move(file), "give pulse text as rtl_433 -w FILE.ook writes it") {
    const auto first = lines_.next();
    if (!first || !first->starts_with(";pulse data"))
      lines_.fail("no ';pulse data'", "pulse text begins so");
  }

  const std::vector<std::string>& wires() const override { return wires_; }
  Seconds now() const override { return now_; }

  std::optional<WireLevel> next() override {
    if (!lit_ && !read_pulse()) return std::nullopt;
    lit_ = !lit_;
    if (lit_) return WireLevel{0, now_, false};
    now_ += gap_after(pulse_);
    return WireLevel{0, std::exchange(now_, now_ + gap_after(gap_)), true};
  }

 private:
  Seconds gap_after(std::uint64_t ticks) const { return static_cast<double>(ticks) * tick_; }

  /// The next line that is a pulse and a gap.
  bool read_pulse() {
    while (const auto line = lines_.next()) {
      if (line->starts_with(';')) {
        read_remark(*line);
      } else if (line->find_first_not_of(" \t") != std::string_view::npos) {
        return parse_pulse(*line);
      }
    }
    return false;
  }

  void read_remark(std::string_view line) {
    constexpr std::string_view key = ";timescale ";
    if (line.starts_with(";fsk"))
      lines_.fail("'" + shown(line) + "'", "an infrared link keys its carrier on and off");
    if (!line.starts_with(key)) return;
    const std::string_view scale = line.substr(key.size());
    if (scale != "1us" && scale != "1ns") lines_.fail("'" + shown(line) + "'", "not 1us or 1ns");
    tick_ = Seconds(scale == "1us" ? 1e-6 : 1e-9);
  }

  bool parse_pulse(std::string_view line) {
    const char* end = line.data() + line.size();
    const auto first = std::from_chars(line.data(), end, pulse_);
    const char* blank = first.ptr;
    while (blank < end && (*blank == ' ' || *blank == '\t')) ++blank;
    const auto second = std::from_chars(blank, end, gap_);
    const bool whole = first.ec == std::errc() && blank > first.ptr && second.ec == std::errc();
    if (!whole && lines_.is_cut()) return false;
    if (!whole || second.ptr != end)
      lines_.fail("'" + shown(line) + "'", "not a pulse and a gap in whole ticks");
    if (now_ + gap_after(pulse_) + gap_after(gap_) > longest_capture)
      lines_.fail("'" + shown(line) + "'", "it ends after more than 30 years");
    return true;
  }

  TextLines lines_;
  std::vector<std::string> wires_ = {"rx"};
  Seconds tick_{1e-6};
  Seconds now_ = lead;
  std::uint64_t pulse_ = 0, gap_ = 0;
  bool lit_ = false;
};

}  // namespace

std::unique_ptr<LogicCapture> open_pulses(std::istream& in, std::string file) {
  return std::make_unique<PulseCapture>(in, std::move(file));
}

}  // namespace sim
