#include "sim/vcd.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <istream>
#include <map>
#include <optional>
#include <ostream>

#include "sim/failure.hpp"

namespace sim {
namespace {

using dsp::LogicTrace;
using dsp::Seconds;

constexpr double ticks_per_second = 1e6;  // finer costs sigrok a sample per tick

std::int64_t tick_of(Seconds t) { return std::llround(t.value * ticks_per_second); }

struct Change {
  std::int64_t tick;
  std::size_t wire;
  bool level;
};

[[maybe_unused]] bool is_name(std::string_view name) {
  return !name.empty() && std::ranges::all_of(name, [](char c) { return c > ' ' && c <= '~'; });
}

/// Identifier code of a wire: printable characters from '!' to '~', least significant first.
std::string code(std::size_t wire) {
  constexpr std::size_t base = '~' - '!' + 1;
  std::string text;
  do {
    text.push_back(static_cast<char>('!' + wire % base));
    wire /= base;
  } while (wire > 0);
  return text;
}

/// Level changes of one wire after tick 0, at most one a tick; returns the level at tick 0.
bool append_changes(std::vector<Change>& changes, const LogicTrace& trace, std::size_t wire) {
  bool at_zero = trace.initial();
  bool written = at_zero;
  bool level = at_zero;
  const auto flips = trace.flips();
  for (std::size_t i = 0; i < flips.size(); ++i) {
    level = !level;
    const std::int64_t tick = tick_of(flips[i]);
    const bool last_of_tick = i + 1 == flips.size() || tick_of(flips[i + 1]) > tick;
    if (!last_of_tick || level == written) continue;
    written = level;
    if (tick > 0) {
      changes.push_back({tick, wire, level});
    } else {
      at_zero = level;
    }
  }
  return at_zero;
}

void write_header(std::ostream& out, std::span<const VcdWire> wires) {
  out << "$version cosys-sim $end\n$timescale 1 us $end\n$scope module cosys $end\n";
  for (std::size_t i = 0; i < wires.size(); ++i) {
    assert(is_name(wires[i].name));
    out << "$var wire 1 " << code(i) << ' ' << wires[i].name << " $end\n";
  }
  out << "$upscope $end\n$enddefinitions $end\n";
}

}  // namespace

void write_vcd(std::ostream& out, std::span<const VcdWire> wires, Seconds duration) {
  write_header(out, wires);
  std::vector<Change> changes;
  out << "#0\n$dumpvars\n";
  for (std::size_t i = 0; i < wires.size(); ++i) {
    out << append_changes(changes, *wires[i].trace, i) << code(i) << '\n';
  }
  out << "$end\n";
  std::ranges::stable_sort(changes, {}, &Change::tick);
  const std::int64_t end = tick_of(duration);
  std::int64_t now = 0;
  for (const Change& change : changes) {
    if (change.tick >= end) break;
    if (change.tick != now) out << '#' << change.tick << '\n';
    now = change.tick;
    out << change.level << code(change.wire) << '\n';
  }
  out << '#' << end << '\n';  // sigrok ends a capture at the last time that it reads
}

namespace {

/// White-space separated words of a file, with the line each is on.
class Words {
 public:
  Words(std::istream& in, std::string_view file) : in_(in), file_(file) {}

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
    throw Failure(
        ExitCode::bad_input,
        fmt::format("{} in {}:{} ({}) give a complete text VCD file, as sigrok-cli -O vcd "
                    "or PulseView write it",
                    problem, file_, line_, why));
  }

 private:
  static constexpr std::size_t max_word = 4096;
  static bool is_space(int c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

  std::istream& in_;
  std::string_view file_;
  std::size_t line_ = 1;
};

/// A word as a message may show it: short and printable.
std::string shown(std::string_view word) {
  std::string text(word.substr(0, 40));
  std::ranges::replace_if(
      text, [](char c) { return c < ' ' || c > '~'; }, '?');
  return text;
}

/// One wire being read: its first value is its initial level if it comes at the file's first time.
struct Wire {
  std::string name;
  std::optional<LogicTrace> trace;
};

class VcdReader {
 public:
  VcdReader(std::istream& in, std::string_view file) : words_(in, file) {}

  std::vector<VcdTrace> read() {
    read_declarations();
    for (std::string word = words_.next(); !word.empty(); word = words_.next()) read_change(word);
    std::vector<VcdTrace> traces;
    for (Wire& wire : wires_) {
      LogicTrace trace = wire.trace.value_or(LogicTrace(true));
      trace.observe_until(now_);
      traces.push_back({std::move(wire.name), std::move(trace)});
    }
    return traces;
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
    const bool scalar = size == "1" && std::ranges::find(not_wires, type) == std::end(not_wires);
    if (!ids_.try_emplace(id, scalar ? wires_.size() : skipped).second || !scalar) return;
    wires_.push_back({std::move(name), std::nullopt});
  }

  void read_change(const std::string& word) {
    const char kind = word.front();
    if (kind == '#') {
      read_time(word);
    } else if (word == "$comment") {
      skip_section();
    } else if (kind == 'b' || kind == 'B') {
      set_wire(words_.need("a vector's code"), word.back());  // some programs write a bit as b1
    } else if (kind == 'r' || kind == 'R' || kind == 's' || kind == 'S') {
      words_.need("a value's code");
    } else if (kind != '$') {  // $dumpvars, $dumpon, ... and their $end only wrap changes
      if (levels.find(kind) == std::string_view::npos) {
        words_.fail("'" + shown(word) + "'", "not a VCD value change");
      }
      set_wire(word.substr(1), kind);
    }
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
    if (time > longest) words_.fail("time " + shown(word), "it is after more than 30 years");
    if (!first_time_) first_time_ = time;
    now_ = time;
  }

  void set_wire(const std::string& id, char value) {
    const auto found = ids_.find(id);
    if (found == ids_.end()) words_.fail("value of '" + shown(id) + "'", "no $var declares it");
    if (found->second == skipped || (value != '0' && value != '1')) return;
    const bool level = value == '1';
    std::optional<LogicTrace>& trace = wires_[found->second].trace;
    if (!trace) trace.emplace(now_ == first_time_.value_or(now_) ? level : true);
    trace->set_at(now_, level);
  }

  static inline const std::map<std::string, double, std::less<>> units = {
      {"s", 1}, {"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}, {"ps", 1e-12}, {"fs", 1e-15}};
  static constexpr std::string_view not_wires[] = {"real", "realtime", "string", "event"};
  static constexpr std::string_view levels = "01xXzZ";
  static constexpr std::size_t skipped = static_cast<std::size_t>(-1);
  static constexpr Seconds longest{1e9};  // keeps every receiver's sample count exact in a double

  Words words_;
  Seconds tick_;
  Seconds now_;
  std::optional<Seconds> first_time_;
  std::map<std::string, std::size_t, std::less<>> ids_;
  std::vector<Wire> wires_;
};

}  // namespace

std::vector<VcdTrace> read_vcd(std::istream& in, std::string_view file) {
  return VcdReader(in, file).read();
}

}  // namespace sim
