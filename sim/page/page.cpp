#include "sim/page/page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "sim/page/content_policy.hpp"
#include "sim/page/embedded.hpp"
#include "sim/picture/svg.hpp"
#include "sim/text/existing_file.hpp"

namespace sim {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view page_head = "<!DOCTYPE html>\n<!-- by cosys-sim -->\n";

std::string element(const char* name, const std::string& text) {
  return fmt::format("<{0}>{1}</{0}>\n", name, xml_escaped(text));
}

std::string paragraphs(const std::string& text) {
  std::string html;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (!line.empty()) html += element("p", line);
  return html;
}

std::string row_html(const std::vector<std::string>& cells, const char* kind) {
  std::string html = "<tr>";
  for (const std::string& cell : cells)
    html +=
        fmt::format("<{}>{}</{}>", kind, xml_escaped(cell), std::string_view(kind).substr(0, 2));
  return html + "</tr>\n";
}

bool is_open(const PageTable& table) {
  constexpr std::size_t long_table = 20;  // rows; these open by a click
  return table.is_answer || table.rows.size() <= long_table;
}

std::string table_html(const PageTable& table, bool is_open) {
  std::string html =
      fmt::format("<details{}><summary>Table ({} row{})</summary>\n<div class=\"table\">",
                  is_open ? " open" : "", table.rows.size(), table.rows.size() == 1 ? "" : "s") +
      "<table class=\"numbers\">\n<thead>" + row_html(table.head, "th scope=\"col\"") +
      "</thead>\n<tbody>\n";
  for (const auto& cells : table.rows) html += row_html(cells, "td");
  return html + "</tbody>\n</table></div></details>\n";
}

/// `kind`: what the script makes of it; empty where it stands still.
std::string picture_html(const PagePicture& picture, const std::string& kind) {
  const std::string still = "<div class=\"still\">\n" + picture.svg + "</div>";
  const std::string live =
      fmt::format("<div class=\"{}\" role=\"group\" aria-label=\"{}\">{}</div>", kind,
                  xml_escaped(picture.caption), still);
  return fmt::format("<figure>\n{}\n<figcaption>{}</figcaption>\n</figure>\n",
                     kind.empty() ? still : live, xml_escaped(picture.caption));
}

/// `number`: in the order of the page, by which its contents lead here.
/// `leads`: it shows the first sentence, so its table makes room for what else is said.
std::string section_html(const PageSection& section, std::size_t number, bool leads) {
  std::string html = fmt::format("<section id=\"section-{}\">\n", number) +
                     element("h2", section.heading) + paragraphs(section.text);
  if (!section.preformatted.empty())
    html += "<details><summary>The whole text</summary>\n" + element("pre", section.preformatted) +
            "</details>\n";
  if (section.picture) html += picture_html(*section.picture, section.picture->live ? "chart" : "");
  if (section.trial) html += picture_html(section.trial->still, "trial");
  if (section.table) html += table_html(*section.table, !leads && is_open(*section.table));
  return html + "</section>\n";
}

/// Whether the first section is a picture of the answer.
bool leads(const Page& page) {
  if (page.sections.empty()) return false;
  const PageSection& first = page.sections.front();
  return first.picture && first.table && first.table->is_answer;
}

/// The first sentence, its picture, and what else is to be said.
std::string answer_html(const Page& page) {
  const std::size_t end = leads(page) ? page.summary.find('\n') : std::string::npos;
  const std::string first = page.summary.substr(0, end);
  std::string html = "<div class=\"verdict\">\n" + paragraphs(first) + "</div>\n";
  if (!leads(page)) return html;
  return html + section_html(page.sections.front(), 0, true) +
         paragraphs(page.summary.substr(first.size()));
}

/// Links to all sections.
std::string contents_html(const std::vector<PageSection>& sections) {
  std::string html = "<nav aria-label=\"Contents\">\n";
  for (std::size_t i = 0; i < sections.size(); ++i)
    html += fmt::format("<a href=\"#section-{}\">{}</a>\n", i, xml_escaped(sections[i].heading));
  return html + "</nav>\n";
}

Json axis_json(const ChartAxis& axis) {
  Json json{{"label", axis.label},
            {"title", title_of(axis)},
            {"logarithmic", axis.logarithmic},
            {"is_count", axis.is_count},
            {"from_zero", axis.from_zero}};
  if (axis.level) json["level"] = {{"at", *axis.level}, {"text", level_text(*axis.level)}};
  return json;
}

const char* curve_kind_name(CurveKind kind) {
  switch (kind) {
    case CurveKind::measured:
      return "measured";
    case CurveKind::theory:
      return "theory";
    case CurveKind::continuous:
      return "continuous";
    case CurveKind::bars:
      break;
  }
  return "bars";
}

std::string chart_json(const Chart& chart) {
  Json curves = Json::array();
  for (std::size_t i = 0; i < chart.curves.size(); ++i) {
    const ChartCurve& curve = chart.curves[i];
    Json points = Json::array();
    for (const ChartPoint& p : curve.points)
      points.push_back(
          {{"x", p.x}, {"y", p.y}, {"low", p.low}, {"high", p.high}, {"is_limit", p.is_limit}});
    const auto colour = colour_of(chart, i);
    curves.push_back({{"name", curve.name},
                      {"kind", curve_kind_name(curve.kind)},
                      {"colour", colour ? Json(*colour) : Json(nullptr)},
                      {"points", points}});
  }
  Json labels = Json::array();
  for (const auto& [name, label] : named_places(chart))
    labels.push_back({{"name", name},
                      {"curve", label.curve},
                      {"point", label.point},
                      {"along", label.along},
                      {"is_left", label.is_left},
                      {"is_above", label.is_above}});
  const Json json{
      {"x", axis_json(chart.x)}, {"y", axis_json(chart.y)}, {"curves", curves}, {"labels", labels}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// Within a script element nothing may look like its end.
std::string within_script(std::string text) {
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at))
    text.replace(at, 1, "\\u003c");
  return text;
}

/// Data for the script, by the name under which it looks for it.
std::string data_html(const char* name, const std::vector<std::string>& data) {
  return fmt::format("<script type=\"application/json\" id=\"{}\">{}</script>\n", name,
                     within_script(fmt::format("[{}]", fmt::join(data, ","))));
}

std::string data_of(const Page& page) {
  std::vector<std::string> charts, trials;
  for (const PageSection& section : page.sections) {
    if (section.picture && section.picture->live)
      charts.push_back(chart_json(*section.picture->live));
    if (section.trial) trials.push_back(section.trial->view);
  }
  return data_html("charts", charts) + data_html("trials", trials);
}

/// The texts of its script elements.
std::vector<std::string> page_scripts() {
  std::vector<std::string> scripts;
  if (!uplot_script.empty())
    scripts.push_back(fmt::format("/*!\n{}*/\n{}", uplot_license, uplot_script));
  scripts.push_back(fmt::format("\n'use strict';\n{{\n{}{}{}{}{}}}\n", axis_script, chart_script,
                                trial_script, table_script, report_script));
  return scripts;
}

}  // namespace

std::string page_as_html(const Page& page) {
  const std::vector<std::string> scripts = page_scripts();
  std::string html = fmt::format(
      "{}<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"{}\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{}</title>\n<style>\n{}{}</style>\n</head>\n<body>\n<main>\n",
      page_head, content_policy(scripts), xml_escaped(page.title), uplot_style, report_style);
  html += element("h1", page.title) + answer_html(page) + contents_html(page.sections);
  for (std::size_t i = leads(page) ? 1 : 0; i < page.sections.size(); ++i)
    html += section_html(page.sections[i], i, false);
  html += "</main>\n" + data_of(page);
  for (const std::string& script : scripts) html += "<script>" + script + "</script>\n";
  return html + "</body>\n</html>\n";
}

bool is_page(const std::filesystem::path& path) {
  return beginning_of(path, page_head.size()) == page_head;
}

}  // namespace sim
