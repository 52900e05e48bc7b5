#include "sim/capture/text_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "sim/failure.hpp"

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

void TextLines::fail_at(std::size_t number, std::string_view problem, std::string_view why,
                        const std::string& suggestion) const {
  throw bad_input(fmt::format("{} in {}:{}", problem, file_, number), std::string(why),
                  suggestion.empty() ? suggestion_ : suggestion);
}

std::string shown(std::string_view text) {
  std::string printable(text.substr(0, 40));
  std::ranges::replace_if(
      printable, [](char c) { return c < ' ' || c > '~'; }, '?');
  return printable;
}

}  // namespace sim
