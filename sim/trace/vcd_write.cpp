#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <ostream>
#include <vector>

#include "sim/trace/vcd.hpp"

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
  const auto edges = trace.edges();
  for (std::size_t i = 0; i < edges.size(); ++i) {
    level = !level;
    const std::int64_t tick = tick_of(edges[i]);
    const bool last_of_tick = i + 1 == edges.size() || tick_of(edges[i + 1]) > tick;
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

void write_levels(std::ostream& out, const std::vector<bool>& levels) {
  for (std::size_t i = 0; i < levels.size(); ++i) out << levels[i] << code(i) << '\n';
}

}  // namespace

void write_vcd(std::ostream& out, std::span<const VcdWire> wires, Seconds duration) {
  write_header(out, wires);
  std::vector<Change> changes;
  std::vector<bool> levels;
  for (std::size_t i = 0; i < wires.size(); ++i)
    levels.push_back(append_changes(changes, *wires[i].trace, i));
  out << "#0\n$dumpvars\n";
  write_levels(out, levels);
  out << "$end\n";
  std::ranges::stable_sort(changes, {}, &Change::tick);
  const std::int64_t end = tick_of(duration);
  std::int64_t now = 0;
  for (const Change& change : changes) {
    if (change.tick >= end) break;
    if (change.tick != now) out << '#' << change.tick << '\n';
    now = change.tick;
    out << change.level << code(change.wire) << '\n';
    levels[change.wire] = change.level;
  }
  // sigrok ends a capture at the last time that it reads, simavr at the last level.
  out << '#' << end << '\n';
  write_levels(out, levels);
}

}  // namespace sim
