#include "sim/capture/wire_choice.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <span>
#include <tuple>
#include <utility>

#include "sim/capture/carrier_demodulator.hpp"
#include "sim/capture/wire_names.hpp"
#include "sim/failure.hpp"
#include "sim/text/escaped_text.hpp"
#include "sim/text/letters.hpp"
#include "sim/text/number_text.hpp"
#include "sim/text/spelling.hpp"

namespace sim {
namespace {

using dsp::Seconds;

constexpr std::size_t most_levels_ahead = 500'000, most_surveyed_wires = 100, most_listed = 24;
constexpr std::uint64_t most_levels = 50'000'000;
constexpr std::size_t most_kept = 8'000'000, most_kept_of_wire = 400'000;  // edges
constexpr std::uint64_t fewest_to_rival = 4;                               // characters
constexpr double reads_as_well = 0.9;                                      // of the other's worth

/// "rxd" of "top.uart.RXD".
std::string last_word(const std::string& name) {
  const std::string text = in_lower_case(without_range(name));
  const auto first = text.find_last_not_of("abcdefghijklmnopqrstuvwxyz");
  return first == std::string::npos ? text : text.substr(first + 1);
}

/// What is sent, where the same is received elsewhere.
bool is_sent(const ChannelSurvey& channel) {
  const std::string word = last_word(channel.name);
  return channel.facts.reading.messages > 0 && (word == "tx" || word == "txd");
}

auto rank_of(const ChannelSurvey& channel) {
  return std::tuple(channel.n_edges > 0, is_called_rx(channel.name),
                    channel.facts.reading.messages > 0, !is_sent(channel),
                    channel.facts.reading.worth());
}

/// Whether `other` is a line of its own that reads as well as `taken`.
bool is_rival(const ChannelSurvey& other, const ChannelSurvey& taken) {
  const LineReading &its = other.facts.reading, &own = taken.facts.reading;
  return other.n_edges > 0 && its.characters >= fewest_to_rival &&
         is_called_rx(other.name) == is_called_rx(taken.name) && is_sent(other) == is_sent(taken) &&
         (its.messages > 0) == (own.messages > 0) && its.worth() >= reads_as_well * own.worth() &&
         other.edges != taken.edges;
}

/// The edges of a wire in memory.
class KeptEdges : public EdgeSource {
 public:
  KeptEdges(bool initial, std::span<const Seconds> edges, Seconds end, Seconds resolution)
      : initial_(initial), edges_(edges), end_(end), resolution_(resolution) {}

  bool initial() const override { return initial_; }
  std::optional<Seconds> next() override {
    if (next_ == edges_.size()) return std::nullopt;
    return edges_[next_++];
  }
  Seconds known_until() const override { return end_; }
  Seconds resolution() const override { return resolution_; }

 private:
  bool initial_;
  std::span<const Seconds> edges_;
  Seconds end_, resolution_;
  std::size_t next_ = 0;
};

/// What is kept of a wire: two edges at one instant cancel.
struct KeptWire {
  bool initial = true, level = true, has_level = false;
  bool is_cut = false;  // edges behind the last are not kept
  std::uint64_t n_edges = 0;
  std::vector<Seconds> edges;

  /// Keeps an edge if there are less than `most`; whether it did.
  bool take(const WireLevel& change, std::size_t most) {
    if (!std::exchange(has_level, true) && change.initial) {
      initial = level = change.level;
      return false;
    }
    if (change.level == level) return false;
    level = change.level;
    ++n_edges;
    if (!edges.empty() && edges.back() == change.at) {
      edges.pop_back();
      return false;
    }
    if (is_cut || edges.size() >= most) {
      is_cut = true;
      return false;
    }
    edges.push_back(change.at);
    return true;
  }
};

/// The wires that are looked at: those with an edge, or the most telling of them.
std::vector<std::size_t> wires_to_survey(const std::vector<std::string>& names,
                                         const std::vector<std::uint64_t>& edges) {
  std::vector<std::size_t> wires;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (edges[i] > 0) wires.push_back(i);
  if (wires.size() <= most_surveyed_wires) return wires;
  std::ranges::stable_sort(wires, [&](std::size_t a, std::size_t b) {
    return std::tuple(is_called_rx(names[a]), edges[a]) >
           std::tuple(is_called_rx(names[b]), edges[b]);
  });
  wires.resize(most_surveyed_wires);
  return wires;
}

std::vector<ChannelSurvey> surveys_of_kept(const std::vector<std::string>& names,
                                           const std::vector<KeptWire>& kept, Seconds end,
                                           Seconds resolution, const LineHints& hints) {
  std::vector<ChannelSurvey> surveys;
  std::vector<std::uint64_t> edges;
  for (std::size_t i = 0; i < names.size(); ++i) {
    edges.push_back(kept[i].n_edges);
    surveys.push_back({.name = names[i], .n_edges = edges.back()});
  }
  for (const std::size_t wire : wires_to_survey(names, edges)) {
    const KeptWire& own = kept[wire];
    KeptEdges kept_edges(own.initial, own.edges, own.is_cut ? own.edges.back() : end, resolution);
    CarrierDemodulator line(kept_edges, hints.carrier);
    surveys[wire] = survey_of(names[wire], line, hints);
    surveys[wire].n_edges = own.n_edges;
  }
  return surveys;
}

template <class IsIt>
std::vector<std::size_t> all_with(const std::vector<std::string>& names, const IsIt& is_it) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (is_it(names[i])) found.push_back(i);
  return found;
}

std::vector<std::string> those(const std::vector<std::string>& names,
                               const std::vector<std::size_t>& places) {
  std::vector<std::string> chosen;
  for (const std::size_t place : places) chosen.push_back(names[place]);
  return chosen;
}

std::string names_to_use(const std::vector<std::string>& names, const std::string& wanted) {
  if (names.size() <= most_listed) return fmt::format("use {}", fmt::join(names, " or "));
  return fmt::format("use {}, or another of its {}", nearest(wanted, names), names.size());
}

}  // namespace

bool is_called_rx(const std::string& name) {
  const std::string word = last_word(name);
  return word == "rx" || word == "rxd";
}

ChannelSurvey survey_of(std::string name, EdgeSource& line, const LineHints& hints) {
  ChannelSurvey survey{.name = std::move(name), .is_surveyed = true};
  while (survey.edges.size() < most_surveyed_edges) {
    const auto edge = line.next();
    if (!edge) break;
    survey.edges.push_back(*edge);
  }
  survey.n_edges = survey.edges.size();
  survey.facts = survey_line({line.initial(), survey.edges, line.known_until(), line.resolution()},
                             hints.inverted, hints.baud);
  return survey;
}

ChannelChoice choice_of_channel(std::span<const ChannelSurvey> channels) {
  const auto best = std::ranges::max_element(channels, {}, rank_of);
  ChannelChoice choice{static_cast<std::size_t>(best - channels.begin()), std::nullopt};
  if (best->n_edges == 0) return choice;
  const auto rival = std::ranges::find_if(
      channels, [&](const ChannelSurvey& other) { return is_rival(other, *best); });
  if (rival != channels.end()) choice.rival = static_cast<std::size_t>(rival - channels.begin());
  return choice;
}

const ChannelSurvey* dead_receiver(std::span<const ChannelSurvey> channels, std::size_t taken) {
  if (is_called_rx(channels[taken].name)) return nullptr;
  const auto dead = std::ranges::find_if(channels, [](const ChannelSurvey& channel) {
    return channel.n_edges == 0 && is_called_rx(channel.name);
  });
  return dead == channels.end() ? nullptr : &*dead;
}

WireSurveys surveys_of(LogicCapture& capture, const LineHints& hints) {
  std::vector<KeptWire> kept(capture.wires().size());
  std::size_t edges = 0;
  bool is_whole = false;
  for (std::uint64_t levels = 0; levels < most_levels && edges < 2 * most_kept && !is_whole;
       ++levels) {
    const auto level = capture.next();
    is_whole = !level;
    if (level)
      edges += kept[level->wire].take(*level,
                                      edges < most_kept ? most_kept_of_wire : most_surveyed_edges)
                   ? 1
                   : 0;
  }
  return {surveys_of_kept(capture.wires(), kept, capture.now(), capture.resolution(), hints),
          is_whole};
}

std::size_t named_channel(const std::vector<std::string>& channels, const std::string& wanted,
                          const std::string& file) {
  const auto exact = std::ranges::find(channels, wanted);
  if (exact != channels.end()) return static_cast<std::size_t>(exact - channels.begin());
  const auto as_shown =
      all_with(channels, [&](const std::string& name) { return escaped_name(name) == wanted; });
  if (as_shown.size() == 1) return as_shown.front();
  const std::string asked = in_lower_case(wanted);
  const auto by_case =
      all_with(channels, [&](const std::string& name) { return in_lower_case(name) == asked; });
  if (by_case.size() == 1) return by_case.front();
  const auto by_range = all_with(channels, [&](const std::string& name) {
    return in_lower_case(without_range(name)) == asked;
  });
  if (by_case.empty() && by_range.size() == 1) return by_range.front();
  const auto is_number = [](const std::string& name) { return parse_number(name).has_value(); };
  const auto number = parse_number(wanted);
  const bool counts = number && std::ranges::none_of(channels, is_number);
  for (std::size_t i = 0; counts && i < channels.size(); ++i)
    if (*number == static_cast<double>(i + 1)) return i;
  const auto by_ending =
      all_with(channels, [&](const std::string& name) { return name.ends_with("." + wanted); });
  if (by_ending.size() > 1)
    throw bad_input(fmt::format("--wire {} is {} wires of {}", wanted, by_ending.size(), file),
                    "their places end so", names_to_use(those(channels, by_ending), wanted));
  throw bad_input(fmt::format("--wire {} is not in {}", wanted, file),
                  "the capture has no such wire", names_to_use(channels, wanted));
}

SurveyedCapture::SurveyedCapture(std::unique_ptr<LogicCapture> capture)
    : capture_(std::move(capture)) {
  read_ahead();
}

std::vector<std::uint64_t> SurveyedCapture::edges() const {
  std::vector<std::uint64_t> edges(wires().size());
  std::vector<std::optional<bool>> last(wires().size());
  for (const WireLevel& level : ahead_) {
    std::optional<bool>& before = last[level.wire];
    edges[level.wire] += before ? *before != level.level : !level.initial && !level.level;
    before = level.level;
  }
  return edges;
}

std::vector<ChannelSurvey> SurveyedCapture::surveys(const LineHints& hints) const {
  std::vector<KeptWire> kept(wires().size());
  for (const WireLevel& level : ahead_) kept[level.wire].take(level, most_kept_of_wire);
  return surveys_of_kept(wires(), kept, end_, resolution(), hints);
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
