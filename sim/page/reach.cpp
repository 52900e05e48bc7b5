#include "sim/page/reach.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <utility>

namespace sim {
namespace {

std::ptrdiff_t count_of(const std::vector<Reach>& reaches, double merit) {
  return std::ranges::count(reaches, merit, &Reach::merit);
}

/// "led.current_ma = 20 mA (between 2 and 3 m)", or how many stand equal.
std::string standing_at(const std::vector<Reach>& reaches, double merit) {
  const Reach& one = *std::ranges::find(reaches, merit, &Reach::merit);
  const auto equal = count_of(reaches, merit);
  return fmt::format("{} ({})", equal == 1 ? one.link : std::to_string(equal), one.words);
}

/// The two ends of their order; empty where all stand equal.
std::string ends_of(const std::vector<Reach>& reaches) {
  const auto [worst, best] = std::ranges::minmax(reaches, {}, &Reach::merit);
  if (worst.merit == best.merit) return "";
  return fmt::format(
      "Of {} links {} come{} first, {} last. ", reaches.size(), standing_at(reaches, best.merit),
      count_of(reaches, best.merit) == 1 ? "s" : "", standing_at(reaches, worst.merit));
}

}  // namespace

std::string reach_heading(const std::string& along) {
  return along == "receiver.range_m" ? "How far each reaches" : "Where each fails";
}

std::string reach_line(const std::vector<Reach>& reaches, const std::vector<std::string>& first) {
  constexpr std::size_t few = 4;
  const std::string along = reaches.front().along;
  if (reaches.size() <= few) {
    std::vector<std::string> each;
    for (const Reach& reach : reaches) each.push_back(reach.link + ": " + reach.words);
    return fmt::format("Frame loss passes 1 % along {} at: {}.\n", along, fmt::join(each, "; "));
  }
  const std::string listed = reach_heading(along) + " is listed below.\n";
  if (first.empty()) {
    const std::string ends = ends_of(reaches);
    return (ends.empty() ? fmt::format("{} links. ", reaches.size()) : ends) + listed;
  }
  return fmt::format("Of {} links {} come{} first. {}", reaches.size(), fmt::join(first, ", "),
                     first.size() == 1 ? "s" : "", listed);
}

PageSection reach_section(std::vector<Reach> reaches) {
  std::ranges::stable_sort(reaches, std::greater<>(), &Reach::merit);
  const std::string along = reaches.front().along;
  PageTable table{
      .head = {"link", "frame loss passes 1 % at " + along}, .rows = {}, .is_answer = true};
  for (Reach& reach : reaches)
    table.rows.push_back({std::move(reach.link), std::move(reach.words)});
  return {.heading = reach_heading(along), .table = std::move(table)};
}

}  // namespace sim
