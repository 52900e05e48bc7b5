#include "sim/capture/text_lines.hpp"

#include <fmt/format.h>

#include <utility>

#include "sim/failure.hpp"
#include "sim/text/escaped_text.hpp"

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
  constexpr std::size_t most_letters = 40;
  std::size_t letters = 0, end = 0;
  for (; end < text.size() && end < 4 * most_letters; ++end)
    if ((text[end] & 0xc0) != 0x80 && ++letters > most_letters) break;
  return escaped_name(text.substr(0, end));
}

}  // namespace sim
