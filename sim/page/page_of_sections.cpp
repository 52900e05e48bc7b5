#include "sim/page/page.hpp"

#include <algorithm>
#include <iterator>
#include <sstream>
#include <utility>

#include "sim/page/differences.hpp"
#include "sim/page/link_range.hpp"
#include "sim/section/picture_sections.hpp"

namespace sim {
namespace {

bool are_alike(const Chart& a, const Chart& b) {
  return a.title == b.title && a.x.label == b.x.label;
}

/// Charts that one result alone has say whose they are.
void name_lone_charts(std::vector<ReportSection>& reports) {
  std::vector<std::pair<Chart*, std::string>> lone;
  for (ReportSection& report : reports)
    for (Chart& chart : report.charts) {
      const auto has_alike = [&](const ReportSection& other) {
        return &other != &report && std::ranges::any_of(other.charts, [&](const Chart& another) {
          return are_alike(chart, another);
        });
      };
      if (std::ranges::none_of(reports, has_alike)) lone.emplace_back(&chart, report.name);
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

void say_whose(ReportSection& report) {
  std::string summary;
  std::istringstream lines(report.summary);
  for (std::string line; std::getline(lines, line);) summary += report.name + ": " + line + "\n";
  report.summary = summary;
  report.scenario.heading = report.name + ": " + report.scenario.heading;
  for (auto* sections : {&report.first, &report.sections})
    for (PageSection& section : *sections) name_section(section, report.name);
  for (Chart& chart : report.charts)
    for (ChartCurve& curve : chart.curves) curve.name = report.name + ", " + curve.name;
}

/// Of a single result what its scenario calls itself.
std::string title_of(const std::vector<ReportSection>& reports) {
  if (reports.size() == 1 && !reports.front().title.empty()) return reports.front().title;
  std::string names;
  for (const ReportSection& report : reports) names += (names.empty() ? "" : ", ") + report.name;
  return names;
}

std::vector<NamedSettings> named_settings(const std::vector<ReportSection>& reports) {
  std::vector<NamedSettings> all;
  for (const ReportSection& report : reports) all.push_back({report.name, report.settings});
  return all;
}

/// All links of all results, named by their results too; none where there is nothing to compare, as
/// one result alone has some, or they have not one abscissa.
std::vector<LinkRange> compared_ranges(const std::vector<ReportSection>& reports) {
  const auto has_some = [](const ReportSection& report) { return !report.link_ranges.empty(); };
  if (std::ranges::count_if(reports, has_some) < 2) return {};
  std::vector<LinkRange> all;
  for (const ReportSection& report : reports)
    for (LinkRange range : report.link_ranges) {
      range.link = report.name + (range.link.empty() ? "" : ", " + range.link);
      if (!all.empty() && all.front().along != range.along) return {};
      all.push_back(std::move(range));
    }
  return all;
}

void compare(Page& page, const std::vector<ReportSection>& reports) {
  if (std::vector<LinkRange> link_ranges = compared_ranges(reports); !link_ranges.empty()) {
    page.summary += link_range_line(link_ranges);
    page.sections.push_back(link_range_section(std::move(link_ranges)));
  }
  page.sections.push_back(differences_section(named_settings(reports)));
}

}  // namespace

Page page_of(std::vector<ReportSection> results) {
  Page page{.title = title_of(results), .summary = {}, .sections = {}};
  std::vector<Chart> charts;
  if (results.size() > 1) {
    compare(page, results);
    name_lone_charts(results);
    std::ranges::for_each(results, say_whose);
  }
  for (ReportSection& result : results) {
    page.summary += result.summary;
    std::ranges::move(result.first, std::back_inserter(page.sections));
    for (Chart& chart : result.charts) add_chart(charts, std::move(chart));
  }
  for (Chart& chart : charts) page.sections.push_back(chart_section(std::move(chart)));
  for (ReportSection& result : results)
    std::ranges::move(result.sections, std::back_inserter(page.sections));
  for (ReportSection& result : results) page.sections.push_back(std::move(result.scenario));
  return page;
}

}  // namespace sim
