#pragma once
// The lines of a capture that is text, of a bounded length each, and what is wrong with one.
#include <cstddef>
#include <istream>
#include <optional>
#include <string>
#include <string_view>

#include "dsp/units.hpp"

namespace sim {

class TextLines {
 public:
  /// `in` must outlive it; `suggestion` ends each message.
  TextLines(std::istream& in, std::string file, std::string suggestion);

  /// Without its end; nothing behind the last. Throws for one of over 64 KiB.
  std::optional<std::string_view> next();
  /// Whether the last line given had no end: it may be cut short.
  bool is_cut() const { return cut_; }

  /// Of the last line given, the first being 1.
  std::size_t number() const { return number_; }

  [[noreturn]] void fail(std::string_view problem, std::string_view why) const {
    fail_at(number_, problem, why);
  }
  /// `suggestion`: empty for the one of all.
  [[noreturn]] void fail_at(std::size_t number, std::string_view problem, std::string_view why,
                            const std::string& suggestion = "") const;

 private:
  std::istream& in_;
  std::string file_, suggestion_, line_;
  std::size_t number_ = 0;
  bool cut_ = false;
};

/// Words of a file as a message may show them: short and printable.
std::string shown(std::string_view text);

/// Every receiver counts samples exactly in a double up to here: more than 30 years.
inline constexpr dsp::Seconds longest_capture{1e9};

}  // namespace sim
