#include "sim/page/report_part.hpp"

#include <algorithm>
#include <iterator>
#include <sstream>
#include <utility>

#include "sim/page/differences.hpp"
#include "sim/page/picture_sections.hpp"

namespace sim {
namespace {

bool are_alike(const Chart& a, const Chart& b) {
  return a.title == b.title && a.x.label == b.x.label;
}

/// Charts that one part alone has say whose they are.
void name_lone_charts(std::vector<ReportPart>& parts) {
  std::vector<std::pair<Chart*, std::string>> lone;
  for (ReportPart& part : parts)
    for (Chart& chart : part.charts) {
      const auto has_alike = [&](const ReportPart& other) {
        return &other != &part && std::ranges::any_of(other.charts, [&](const Chart& another) {
          return are_alike(chart, another);
        });
      };
      if (std::ranges::none_of(parts, has_alike)) lone.emplace_back(&chart, part.name);
    }
  for (const auto& [chart, name] : lone) chart->title = name + ": " + chart->title;
}

/// An axis that has a place for what is on both.
void join_axis(ChartAxis& axis, const ChartAxis& other) {
  axis.logarithmic = axis.logarithmic && other.logarithmic;
  axis.from_zero = axis.from_zero || other.from_zero;
  if (!axis.level) axis.level = other.level;
}

void add_chart(std::vector<Chart>& charts, Chart chart) {
  const auto same =
      std::ranges::find_if(charts, [&](const Chart& other) { return are_alike(other, chart); });
  if (same == charts.end()) {
    charts.push_back(std::move(chart));
    return;
  }
  join_axis(same->x, chart.x);
  join_axis(same->y, chart.y);
  std::ranges::move(chart.curves, std::back_inserter(same->curves));
}

/// Whose a section is, in its heading and in the names of the files that its pictures become.
void name_section(PageSection& section, const std::string& name) {
  section.heading = name + ": " + section.heading;
  const auto name_picture = [&](PagePicture& picture) {
    picture.name = picture_name(name + " " + picture.name);
  };
  if (section.picture) name_picture(*section.picture);
  if (section.trial) name_picture(section.trial->still);
}

void say_whose(ReportPart& part) {
  std::string verdict;
  std::istringstream lines(part.verdict);
  for (std::string line; std::getline(lines, line);) verdict += part.name + ": " + line + "\n";
  part.verdict = verdict;
  part.scenario.heading = part.name + ": " + part.scenario.heading;
  for (auto* sections : {&part.first, &part.sections})
    for (PageSection& section : *sections) name_section(section, part.name);
  for (Chart& chart : part.charts)
    for (ChartCurve& curve : chart.curves) curve.name = part.name + ", " + curve.name;
}

/// Of a single result what its scenario calls itself.
std::string title_of(const std::vector<ReportPart>& parts) {
  if (parts.size() == 1 && !parts.front().title.empty()) return parts.front().title;
  std::string names;
  for (const ReportPart& part : parts) names += (names.empty() ? "" : ", ") + part.name;
  return names;
}

std::vector<NamedSettings> named_settings(const std::vector<ReportPart>& parts) {
  std::vector<NamedSettings> all;
  for (const ReportPart& part : parts) all.push_back({part.name, part.settings});
  return all;
}

/// All links of all results, named by their results too; none where there is nothing to compare, as
/// one result alone has some, or they have not one abscissa.
std::vector<Reach> compared_reaches(const std::vector<ReportPart>& parts) {
  const auto has_some = [](const ReportPart& part) { return !part.reaches.empty(); };
  if (std::ranges::count_if(parts, has_some) < 2) return {};
  std::vector<Reach> all;
  for (const ReportPart& part : parts)
    for (Reach reach : part.reaches) {
      reach.link = part.name + (reach.link.empty() ? "" : ", " + reach.link);
      if (!all.empty() && all.front().along != reach.along) return {};
      all.push_back(std::move(reach));
    }
  return all;
}

void compare(Page& page, const std::vector<ReportPart>& parts) {
  if (std::vector<Reach> reaches = compared_reaches(parts); !reaches.empty()) {
    page.verdict += reach_line(reaches, {});
    page.sections.push_back(reach_section(std::move(reaches)));
  }
  page.sections.push_back(differences_section(named_settings(parts)));
}

}  // namespace

Page page_of(std::vector<ReportPart> parts) {
  Page page{.title = title_of(parts), .verdict = {}, .sections = {}};
  std::vector<Chart> charts;
  if (parts.size() > 1) {
    compare(page, parts);
    name_lone_charts(parts);
    std::ranges::for_each(parts, say_whose);
  }
  for (ReportPart& part : parts) page.sections.push_back(std::move(part.scenario));
  for (ReportPart& part : parts) {
    page.verdict += part.verdict;
    std::ranges::move(part.first, std::back_inserter(page.sections));
    for (Chart& chart : part.charts) add_chart(charts, std::move(chart));
  }
  for (Chart& chart : charts) page.sections.push_back(chart_section(std::move(chart)));
  for (ReportPart& part : parts)
    std::ranges::move(part.sections, std::back_inserter(page.sections));
  return page;
}

}  // namespace sim
