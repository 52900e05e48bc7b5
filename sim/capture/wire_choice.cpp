#include "sim/capture/wire_choice.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <span>
#include <tuple>

#include "sim/capture/keyed_wire.hpp"
#include "sim/failure.hpp"
#include "sim/text/number_text.hpp"

namespace sim {
namespace {

using dsp::Seconds;

constexpr std::size_t most_levels_ahead = 500'000, most_surveyed_flips = 32768;
constexpr std::uint64_t fewest_to_rival = 4;  // characters
constexpr double reads_as_well = 0.9;         // of the other's worth

std::string in_lower_case(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

/// "rx", "D1 RX", "top.uart.rxd", but not "proxy".
bool is_called_rx(const std::string& name) {
  const std::string text = in_lower_case(name);
  const auto first = text.find_last_not_of("abcdefghijklmnopqrstuvwxyz");
  const std::string last = first == std::string::npos ? text : text.substr(first + 1);
  return last == "rx" || last == "rxd";
}

auto rank_of(const WireSurvey& wire) {
  return std::tuple(wire.edges > 0, is_called_rx(wire.name), wire.facts.reading.messages > 0,
                    wire.facts.reading.worth());
}

/// Levels in memory, as a capture.
class KeptLevels : public LogicCapture {
 public:
  KeptLevels(const std::vector<std::string>& wires, const std::deque<WireLevel>& levels,
             Seconds end)
      : wires_(wires), levels_(levels), end_(end) {}

  const std::vector<std::string>& wires() const override { return wires_; }
  std::optional<WireLevel> next() override {
    if (next_ == levels_.size()) return std::nullopt;
    return levels_[next_++];
  }
  Seconds now() const override { return end_; }

 private:
  const std::vector<std::string>& wires_;
  const std::deque<WireLevel>& levels_;
  Seconds end_;
  std::size_t next_ = 0;
};

LineFacts facts_of_wire(KeptLevels levels, std::size_t wire, const LineHints& hints) {
  WireFlips flips(levels, wire);
  KeyedWire line(flips, hints.carrier);
  std::vector<Seconds> read;
  while (read.size() < most_surveyed_flips) {
    const auto flip = line.next();
    if (!flip) break;
    read.push_back(*flip);
  }
  return survey_line({line.initial(), read, line.known_until()}, hints.inverted, hints.baud);
}

/// Changes of each wire's level.
std::vector<std::uint64_t> edges_of(const std::deque<WireLevel>& levels, std::size_t wires) {
  std::vector<std::uint64_t> edges(wires);
  std::vector<std::optional<bool>> last(wires);
  for (const WireLevel& level : levels) {
    std::optional<bool>& before = last[level.wire];
    edges[level.wire] += before ? *before != level.level : !level.initial && !level.level;
    before = level.level;
  }
  return edges;
}

template <class IsIt>
std::vector<std::size_t> all_with(const std::vector<std::string>& wires, const IsIt& is_it) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < wires.size(); ++i)
    if (is_it(wires[i])) found.push_back(i);
  return found;
}

}  // namespace

WireChoice choice_of_wire(const std::vector<WireSurvey>& wires) {
  const auto best = std::ranges::max_element(wires, {}, rank_of);
  WireChoice choice{static_cast<std::size_t>(best - wires.begin()), std::nullopt};
  const LineReading& taken = best->facts.reading;
  if (best->edges == 0 || is_called_rx(best->name)) return choice;
  for (std::size_t i = 0; i < wires.size(); ++i) {
    const LineReading& other = wires[i].facts.reading;
    if (i == choice.wire || wires[i].edges == 0 || other.characters < fewest_to_rival) continue;
    if ((other.messages > 0) == (taken.messages > 0) &&
        other.worth() >= reads_as_well * taken.worth())
      choice.rival = choice.rival.value_or(i);
  }
  return choice;
}

std::size_t named_wire(const std::vector<std::string>& wires, const std::string& wanted,
                       const std::string& file) {
  const auto exact = std::ranges::find(wires, wanted);
  if (exact != wires.end()) return static_cast<std::size_t>(exact - wires.begin());
  const auto alike = all_with(
      wires, [&](const std::string& name) { return in_lower_case(name) == in_lower_case(wanted); });
  if (alike.size() == 1) return alike.front();
  const auto is_number = [](const std::string& name) { return parse_number(name).has_value(); };
  const auto number = parse_number(wanted);
  for (std::size_t i = 0; number && std::ranges::none_of(wires, is_number) && i < wires.size(); ++i)
    if (*number == static_cast<double>(i + 1)) return i;
  throw bad_input(fmt::format("--wire {} is not in {}", wanted, file),
                  "the capture has no such wire", fmt::format("use {}", fmt::join(wires, " or ")));
}

SurveyedCapture::SurveyedCapture(std::unique_ptr<LogicCapture> capture, const LineHints& hints)
    : capture_(std::move(capture)) {
  read_ahead();
  const std::vector<std::uint64_t> edges = edges_of(ahead_, wires().size());
  for (std::size_t i = 0; i < wires().size(); ++i) {
    surveys_.push_back({wires()[i], edges[i], {}});
    if (edges[i] > 0)
      surveys_.back().facts = facts_of_wire(KeptLevels(wires(), ahead_, end_), i, hints);
  }
}

void SurveyedCapture::read_ahead() {
  while (ahead_.size() < most_levels_ahead) {
    const auto level = capture_->next();
    if (!level) {
      whole_ = true;
      break;
    }
    ahead_.push_back(*level);
  }
  end_ = capture_->now();
}

std::optional<WireLevel> SurveyedCapture::next() {
  if (ahead_.empty()) {
    is_played_ = true;
    return whole_ ? std::nullopt : capture_->next();
  }
  const WireLevel level = ahead_.front();
  ahead_.pop_front();
  now_ = level.at;
  return level;
}

Seconds SurveyedCapture::now() const { return is_played_ ? capture_->now() : now_; }

}  // namespace sim
