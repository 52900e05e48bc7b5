#include "sim/capture/text_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "sim/capture/sample_capture.hpp"
#include "sim/failure.hpp"
#include "sim/text/number_text.hpp"

namespace sim {
namespace {

constexpr std::size_t longest_line = 65536;

}  // namespace

TextLines::TextLines(std::istream& in, std::string file, std::string suggestion)
    : in_(in), file_(std::move(file)), suggestion_(std::move(suggestion)) {}

std::optional<std::string_view> TextLines::next() {
  using Traits = std::istream::traits_type;
  line_.clear();
  ++number_;
  for (int c = in_.rdbuf()->sbumpc(); c != '\n'; c = in_.rdbuf()->sbumpc()) {
    cut_ = c == Traits::eof();
    if (cut_ && line_.empty()) return std::nullopt;
    if (cut_) break;
    line_.push_back(static_cast<char>(c));
    if (line_.size() > longest_line) fail("a line of over 64 KiB", "no capture has one");
  }
  if (line_.ends_with('\r')) line_.pop_back();
  return line_;
}

void TextLines::fail(std::string_view problem, std::string_view why) const {
  throw bad_input(fmt::format("{} in {}:{}", problem, file_, number_), std::string(why),
                  suggestion_);
}

std::string shown(std::string_view text) {
  std::string printable(text.substr(0, 40));
  std::ranges::replace_if(
      printable, [](char c) { return c < ' ' || c > '~'; }, '?');
  return printable;
}

std::optional<dsp::Hertz> parse_sample_rate(std::string_view text) {
  static const std::map<std::string, double, std::less<>> units = {
      {"", 1},    {"Hz", 1},    {"k", 1e3}, {"kHz", 1e3}, {"KHz", 1e3},
      {"M", 1e6}, {"MHz", 1e6}, {"G", 1e9}, {"GHz", 1e9}};
  const std::size_t digits = std::min(text.find_first_not_of("0123456789.+e "), text.size());
  const auto number = parse_number(text.substr(0, digits));
  const auto unit = units.find(text.substr(digits));
  if (!number || unit == units.end()) return std::nullopt;
  const dsp::Hertz rate(*number * unit->second);
  return is_sample_rate(rate) ? std::optional(rate) : std::nullopt;
}

}  // namespace sim
