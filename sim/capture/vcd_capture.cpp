#include "sim/capture/vcd_capture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <functional>
#include <istream>
#include <map>
#include <optional>
#include <utility>

#include "sim/capture/text_lines.hpp"
#include "sim/failure.hpp"

namespace sim {
namespace {

using dsp::Seconds;

/// White-space separated words of a file, with the line each is on.
class Words {
 public:
  Words(std::istream& in, std::string file) : in_(in), file_(std::move(file)) {}

  /// Empty at the end of the file.
  std::string next() {
    using Traits = std::istream::traits_type;
    std::string word;
    for (int c = in_.rdbuf()->sgetc(); c != Traits::eof(); c = in_.rdbuf()->snextc()) {
      if (is_space(c)) {
        if (!word.empty()) break;
        if (c == '\n') ++line_;
      } else {
        word.push_back(static_cast<char>(c));
        if (word.size() > max_word) fail("a word of over 4096 characters", "no VCD has one");
      }
    }
    return word;
  }

  std::string need(std::string_view what) {
    std::string word = next();
    if (word.empty()) fail("the file ends early", fmt::format("{} is missing", what));
    return word;
  }

  [[noreturn]] void fail(std::string_view problem, std::string_view why) const {
    throw bad_input(fmt::format("{} in {}:{}", problem, file_, line_), std::string(why),
                    "give a complete text VCD file, as sigrok-cli -O vcd or PulseView write it");
  }

 private:
  static constexpr std::size_t max_word = 4096;
  static bool is_space(int c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

  std::istream& in_;
  std::string file_;
  std::size_t line_ = 1;
};

class VcdCapture : public LogicCapture {
 public:
  VcdCapture(std::istream& in, std::string file) : words_(in, std::move(file)) {
    read_declarations();
  }

  const std::vector<std::string>& wires() const override { return wires_; }
  Seconds now() const override { return now_; }

  std::optional<WireLevel> next() override {
    for (std::string word = words_.next(); !word.empty(); word = words_.next())
      if (const auto change = read_change(word)) return change;
    return std::nullopt;
  }

 private:
  void read_declarations() {
    for (;;) {
      const std::string word = words_.need("$enddefinitions");
      if (word == "$enddefinitions") break;
      if (word == "$timescale") {
        read_timescale();
      } else if (word == "$var") {
        read_variable();
      } else if (word.front() == '$') {
        skip_section();
      } else {
        words_.fail("'" + shown(word) + "'", "not a VCD declaration");
      }
    }
    skip_section();
    if (tick_.value <= 0) words_.fail("no $timescale", "times have no unit without it");
  }

  void skip_section() {
    while (words_.need("$end") != "$end") {
    }
  }

  void read_timescale() {
    std::string text = words_.need("a timescale");
    for (std::string word = words_.need("$end"); word != "$end"; word = words_.need("$end")) {
      if (text.size() < 20) text += word;  // "1 us" is as good as "1us"
    }
    unsigned count = 0;
    const char* end = text.data() + text.size();
    const auto number = std::from_chars(text.data(), end, count);
    const auto unit = units.find(std::string_view(number.ptr, end));
    if (count == 0 || unit == units.end()) {
      words_.fail("timescale '" + shown(text) + "'", "it must be like 1us, 10 ns or 100 ps");
    }
    tick_ = Seconds(count * unit->second);
  }

  void read_variable() {
    const std::string type = words_.need("a variable's type");
    const std::string size = words_.need("a variable's size");
    const std::string id = words_.need("a variable's code");
    std::string name;
    for (std::string word = words_.need("$end"); word != "$end"; word = words_.need("$end")) {
      if (name.size() < 256) name += word;  // "data [3]" is one bit of a vector: data[3]
    }
    room_used_ += room_of_variable + id.size() + name.size();
    if (room_used_ > most_room) words_.fail("too many variables", "they would take over 64 MiB");
    const bool scalar = size == "1" && std::ranges::find(not_wires, type) == std::end(not_wires);
    if (!ids_.try_emplace(id, scalar ? wires_.size() : skipped).second || !scalar) return;
    wires_.push_back(std::move(name));
    seen_.push_back(false);
  }

  std::optional<WireLevel> read_change(const std::string& word) {
    const char kind = word.front();
    if (kind == '#') {
      read_time(word);
    } else if (word == "$comment") {
      skip_section();
    } else if (kind == 'b' || kind == 'B') {
      return level(words_.need("a vector's code"), word.back());  // some programs write a bit as b1
    } else if (kind == 'r' || kind == 'R' || kind == 's' || kind == 'S') {
      words_.need("a value's code");
    } else if (kind != '$') {  // $dumpvars, $dumpon, ... and their $end only wrap changes
      if (levels.find(kind) == std::string_view::npos) {
        words_.fail("'" + shown(word) + "'", "not a VCD value change");
      }
      return level(word.substr(1), kind);
    }
    return std::nullopt;
  }

  void read_time(const std::string& word) {
    std::uint64_t ticks = 0;
    const char* end = word.data() + word.size();
    const auto number = std::from_chars(word.data() + 1, end, ticks);
    if (number.ec != std::errc() || number.ptr != end) {
      words_.fail("time '" + shown(word) + "'", "it must be # and a whole number of ticks");
    }
    const Seconds time = static_cast<double>(ticks) * tick_;
    if (time < now_) words_.fail("time " + shown(word), "it is before the time that it follows");
    if (time > longest_capture)
      words_.fail("time " + shown(word), "it is after more than 30 years");
    if (!first_time_) first_time_ = time;
    now_ = time;
  }

  std::optional<WireLevel> level(const std::string& id, char value) {
    const auto found = ids_.find(id);
    if (found == ids_.end()) words_.fail("value of '" + shown(id) + "'", "no $var declares it");
    const std::size_t wire = found->second;
    if (wire == skipped || (value != '0' && value != '1')) return std::nullopt;
    const bool first = !seen_[wire];
    seen_[wire] = true;
    return WireLevel{wire, now_, value == '1', first && now_ == first_time_.value_or(now_)};
  }

  static inline const std::map<std::string, double, std::less<>> units = {
      {"s", 1}, {"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}, {"ps", 1e-12}, {"fs", 1e-15}};
  static constexpr std::string_view not_wires[] = {"real", "realtime", "string", "event"};
  static constexpr std::string_view levels = "01xXzZ";
  static constexpr std::size_t room_of_variable = 128;  // in map and vector, about
  static constexpr std::size_t most_room = std::size_t{64} << 20U;
  static constexpr std::size_t skipped = static_cast<std::size_t>(-1);

  Words words_;
  Seconds tick_;
  Seconds now_;
  std::optional<Seconds> first_time_;
  std::map<std::string, std::size_t, std::less<>> ids_;
  std::vector<std::string> wires_;
  std::vector<bool> seen_;  // whether a wire had a level
  std::size_t room_used_ = 0;
};

}  // namespace

std::unique_ptr<LogicCapture> open_vcd(std::istream& in, std::string file) {
  return std::make_unique<VcdCapture>(in, std::move(file));
}

}  // namespace sim
