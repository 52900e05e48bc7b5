#include "sim/page/link_range.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <utility>

#include "sim/result/ranking.hpp"

namespace sim {
namespace {

constexpr std::size_t few = 4;  // links that are named one by one

/// "led.current_ma = 20 mA (between 2 and 3 m)", of a few that stand equal all, of more how many.
std::string standing_at(const std::vector<LinkRange>& ranges, double merit) {
  std::vector<std::string> equal;
  for (const LinkRange& range : ranges)
    if (range.merit == merit) equal.push_back(fmt::format("{} ({})", range.link, range.words));
  if (equal.size() <= few) return fmt::format("{}", fmt::join(equal, ", "));
  const LinkRange& one = *std::ranges::find(ranges, merit, &LinkRange::merit);
  return fmt::format("{} of them ({})", equal.size(), one.words);
}

/// "5 links", or "5 links that are counted far enough (of 17)".
std::string links_of(const std::vector<LinkRange>& ranges) {
  const auto told = std::ranges::count(ranges, true, &LinkRange::is_told);
  if (told == std::ssize(ranges)) return fmt::format("{} links", told);
  return fmt::format("{} links that are counted far enough (of {})", told, ranges.size());
}

/// The two ends of their order; empty where all stand equal.
std::string ends_of(std::vector<LinkRange> ranges) {
  const std::string links = links_of(ranges);
  std::erase_if(ranges, [](const LinkRange& range) { return !range.is_told; });
  if (ranges.empty()) return "";
  const auto [worst, best] = std::ranges::minmax(ranges, {}, &LinkRange::merit);
  if (worst.merit == best.merit) return "";
  return fmt::format("First of {}: {}; last: {}. ", links, standing_at(ranges, best.merit),
                     standing_at(ranges, worst.merit));
}

}  // namespace

std::string link_range_heading(const std::string& along, std::size_t links) {
  const char* one = links == 1 ? "it" : "each";
  return along == distance_key ? fmt::format("How far {} reaches", one)
                               : fmt::format("Where {} fails", one);
}

std::string link_range_line(const std::vector<LinkRange>& ranges) {
  const std::string along = ranges.front().along;
  if (ranges.size() <= few) {
    std::vector<std::string> each;
    for (const LinkRange& range : ranges) each.push_back(range.link + ": " + range.words);
    return fmt::format("Frame loss passes 1 % along {} at: {}.\n", along, fmt::join(each, "; "));
  }
  const std::string ends = ends_of(ranges);
  return (ends.empty() ? fmt::format("{} links. ", ranges.size()) : ends) +
         link_range_heading(along, ranges.size()) + " is listed below.\n";
}

PageSection link_range_section(std::vector<LinkRange> ranges) {
  std::ranges::stable_sort(ranges, std::greater<>(), &LinkRange::merit);
  const std::string along = ranges.front().along;
  PageTable table{
      .head = {"link", "frame loss passes 1 % at " + along}, .rows = {}, .is_answer = true};
  for (LinkRange& range : ranges)
    table.rows.push_back({std::move(range.link), std::move(range.words)});
  return {.heading = link_range_heading(along, ranges.size()), .table = std::move(table)};
}

}  // namespace sim
