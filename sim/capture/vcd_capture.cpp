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

#include "sim/capture/capture_units.hpp"
#include "sim/capture/text_lines.hpp"
#include "sim/capture/wire_names.hpp"
#include "sim/failure.hpp"
#include "sim/text/letters.hpp"

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
      is_cut_ = false;
      if (is_space(c)) {
        if (!word.empty()) return word;
        if (c == '\n') ++line_;
      } else {
        word.push_back(static_cast<char>(c));
        if (word.size() > max_word) shorten(word);
      }
    }
    is_cut_ = !word.empty();
    return word;
  }

  /// Whether the file ends right behind the last word: it may be half of one.
  bool is_cut() const { return is_cut_; }

  std::string need(std::string_view what) {
    std::string word = next();
    if (word.empty()) fail("the file ends early", fmt::format("{} is missing", what));
    return word;
  }

  [[noreturn]] void fail(std::string_view problem, std::string_view why,
                         const std::string& suggestion =
                             "give a complete text VCD file, as "
                             "sigrok-cli -O vcd or PulseView write "
                             "it") const {
    throw bad_input(fmt::format("{} in {}:{}", problem, file_, line_), std::string(why),
                    suggestion);
  }

 private:
  static constexpr std::size_t max_word = 4096;
  /// Of a vector's value the last bit is enough, and of a text nothing.
  void shorten(std::string& word) const {
    if (std::string_view("bBsS").find(word.front()) == std::string_view::npos)
      fail("a word of over 4096 characters", "no VCD has one");
    word.erase(1, word.size() - 2);
  }
  static bool is_space(int c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

  std::istream& in_;
  std::string file_;
  std::size_t line_ = 1;
  bool is_cut_ = false;
};

class VcdCapture : public LogicCapture {
 public:
  VcdCapture(std::istream& in, std::string file, const CaptureSettings& settings,
             CaptureFacts& facts)
      : words_(in, std::move(file)), names_(settings.wire), asked_(settings.wire) {
    read_declarations(settings.tick.has_value());
    names_.finish();
    refuse_asked_vector();
    if (vectors_ > 0 && asked_.empty())
      facts.assumed.push_back(fmt::format("no line in its vectors ({})", vectors_));
    tick_ = settings.tick_over(tick_);
    if (!tick_)
      words_.fail("no $timescale", "times have no unit without it", "say --time-unit 1us");
    facts.time = ticks_text(*tick_);
  }

  const std::vector<std::string>& wires() const override { return names_.list(); }
  Seconds now() const override { return now_; }

  /// A change of a code is one of each of its names.
  std::optional<WireLevel> next() override {
    if (!place_ && !read_level()) return std::nullopt;
    change_.wire = *place_;
    place_ = names_.behind(*place_);
    return change_;
  }

 private:
  void read_declarations(bool tick_is_told) {
    for (;;) {
      const std::string word = words_.need("$enddefinitions");
      if (word == "$enddefinitions") break;
      if (word == "$timescale") {
        read_timescale(tick_is_told);
      } else if (word == "$var") {
        read_variable();
      } else if (word == "$scope") {
        read_scope();
      } else if (word == "$upscope") {
        names_.leave();
        skip_section();
      } else if (word.front() == '$') {
        skip_section();
      } else {
        words_.fail("'" + shown(word) + "'", "not a VCD declaration");
      }
    }
    skip_section();
  }

  void skip_section() {
    while (words_.need("$end") != "$end") {
    }
  }

  void read_timescale(bool is_told) {
    std::string text = words_.need("a timescale");
    for (std::string word = words_.need("$end"); word != "$end"; word = words_.need("$end")) {
      if (text.size() < 20) text += word;  // "1 us" is as good as "1us"
    }
    unsigned count = 0;
    const char* end = text.data() + text.size();
    const auto number = std::from_chars(text.data(), end, count);
    const auto unit = units.find(std::string_view(number.ptr, end));
    const bool is_known = count > 0 && unit != units.end();
    if (!is_known && is_told) return;
    if (!is_known)
      words_.fail("timescale '" + shown(text) + "'", "it must be like 1us, 10 ns or 100 ps",
                  "say --time-unit 1us");
    const Seconds tick(count * unit->second);
    if (tick_ && *tick_ != tick && !is_told)
      words_.fail("timescale '" + shown(text) + "'", "another one stands before it",
                  "say --time-unit 1us");
    tick_ = tick;
  }

  /// The words up to $end as one: "data [3]" is one bit of a vector, data[3].
  std::string read_name() {
    std::string name;
    for (std::string word = words_.need("$end"); word != "$end"; word = words_.need("$end"))
      name += word.substr(0, longest_name - name.size());
    return name;
  }

  void read_scope() {
    const bool has_no_name = words_.need("a scope's type") == "$end";
    names_.enter(has_no_name ? "" : read_name());
    check_room();
  }

  void read_variable() {
    const std::string type = words_.need("a variable's type");
    if (type == "port") refuse_extended("'$var port'");
    const std::string size = words_.need("a variable's size");
    const std::string id = words_.need("a variable's code");
    std::string name = read_name();
    room_of_codes_ += room_of_code + id.size();
    check_room();
    const bool is_wire = std::ranges::find(not_wires, type) == std::end(not_wires);
    const bool scalar = size == "1" && is_wire;
    if (is_wire && !scalar) note_vector(name, size);
    const auto code = codes_.try_emplace(id, scalar ? seen_.size() : skipped);
    if (!scalar || code.first->second == skipped) return;
    if (code.second) seen_.push_back(false);
    names_.add(std::move(name), code.first->second);
  }

  void note_vector(const std::string& name, const std::string& size) {
    ++vectors_;
    const std::string base = name.substr(0, name.find('['));
    if (!asked_.empty() && asked_.substr(0, asked_.find('[')) == base) asked_vector_ = size;
  }

  void refuse_asked_vector() const {
    const auto is_it = [&](const std::string& name) {
      return in_lower_case(without_range(name)) == in_lower_case(asked_) || name == asked_;
    };
    if (asked_vector_.empty() || std::ranges::any_of(names_.list(), is_it)) return;
    words_.fail("--wire " + asked_ + " is no wire",
                "it is a vector of " + shown(asked_vector_) + " bits, and a line is one bit",
                "dump that bit as a wire");
  }

  void check_room() const {
    if (room_of_codes_ + names_.bytes() > most_room)
      words_.fail("too many variables", "they would take over 96 MiB");
  }

  [[noreturn]] void refuse_extended(std::string_view what) const {
    words_.fail(what, "an extended VCD says who drives a port", "dump it with $dumpvars");
  }

  /// Goes on to the next known level of a wire.
  bool read_level() {
    for (std::string word = words_.next(); !word.empty(); word = words_.next())
      if (read_change(word)) return true;
    return false;
  }

  bool read_change(const std::string& word) {
    const char kind = word.front();
    if (levels.find(kind) != std::string_view::npos) {
      return level(word.size() > 1 ? word.substr(1) : words_.next(), kind);
    } else if (kind == '#') {
      read_time(word);
    } else if (kind == 'b' || kind == 'B') {  // some programs write a bit as b1
      if (words_.is_cut()) return false;
      if (levels.find(word.back()) == std::string_view::npos)
        words_.fail("'" + shown(word) + "'", "not a VCD value change");
      return level(words_.next(), word.back());
    } else if (kind == 'r' || kind == 'R' || kind == 's' || kind == 'S') {
      words_.next();
    } else if (word == "$comment") {
      skip_section();
    } else if (word.starts_with("$dumpports")) {
      refuse_extended(word);
    } else if (kind != '$' &&
               !words_.is_cut()) {  // $dumpvars, $dumpon, ... and their $end only wrap changes
      words_.fail("'" + shown(word) + "'", "not a VCD value change");
    }
    return false;
  }

  void read_time(const std::string& word) {
    double ticks = 0;
    const char* end = word.data() + word.size();
    const auto number = std::from_chars(word.data() + 1, end, ticks, std::chars_format::fixed);
    const bool whole = number.ec == std::errc() && number.ptr == end;
    if (words_.is_cut() && !(whole && ticks * *tick_ >= now_)) return;
    if (!whole || word[1] < '0' || word[1] > '9')
      words_.fail("time '" + shown(word) + "'", "it must be # and a number of ticks");
    const Seconds time = ticks * *tick_;
    if (time < now_) words_.fail("time " + shown(word), "it is before the time that it follows");
    if (time > longest_capture)
      words_.fail("time " + shown(word), "it is after more than 30 years");
    if (!first_time_) first_time_ = time;
    now_ = time;
  }

  /// Whether the word at the end of the file may be cut short: of no code, or of the beginning of
  /// one.
  bool is_half(const std::string& id) const {
    const auto next = codes_.upper_bound(id);
    return codes_.find(id) == codes_.end() || (next != codes_.end() && next->first.starts_with(id));
  }

  /// Whether it is a known level of a wire, which is then the change at hand.
  bool level(const std::string& id, char value) {
    const auto found = codes_.find(id);
    if (id.empty() || (words_.is_cut() && is_half(id))) return false;
    if (found == codes_.end()) words_.fail("value of '" + shown(id) + "'", "no $var declares it");
    const std::size_t code = found->second;
    const bool high = ones.find(value) != std::string_view::npos;
    if (code == skipped || (!high && zeros.find(value) == std::string_view::npos)) return false;
    const bool first = !seen_[code];
    seen_[code] = true;
    change_ = {0, now_, high, first && now_ == first_time_.value_or(now_)};
    place_ = names_.first_of(code);
    return true;
  }

  static inline const std::map<std::string, double, std::less<>> units = {
      {"s", 1}, {"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}, {"ps", 1e-12}, {"fs", 1e-15}};
  static constexpr std::string_view not_wires[] = {"real", "realtime", "string", "event"};
  static constexpr std::string_view zeros = "0Ll", ones = "1Hh", levels = "01LlHhXxZzUuWw-";
  static constexpr std::size_t longest_name = 256;
  static constexpr std::size_t room_of_code = 96;  // in the map, about
  static constexpr std::size_t most_room = std::size_t{96} << 20U;
  static constexpr std::size_t skipped = static_cast<std::size_t>(-1);

  Words words_;
  WireNames names_;
  std::string asked_,
      asked_vector_;  // the wire asked for; the size of the vector that is called so
  std::size_t vectors_ = 0;
  std::optional<Seconds> tick_;
  Seconds now_;
  std::optional<Seconds> first_time_;
  std::map<std::string, std::size_t, std::less<>> codes_;
  std::vector<bool> seen_;  // whether a code had a level
  std::size_t room_of_codes_ = 0;
  WireLevel change_;
  std::optional<std::size_t> place_;  // of the name that the change is given for next
};

}  // namespace

std::unique_ptr<LogicCapture> open_vcd(std::istream& in, std::string file,
                                       const CaptureSettings& settings, CaptureFacts& facts) {
  return std::make_unique<VcdCapture>(in, std::move(file), settings, facts);
}

}  // namespace sim
