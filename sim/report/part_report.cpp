#include "sim/report/part_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "sim/picture/chart.hpp"
#include "sim/text/json_answer.hpp"
#include "sim/text/unit_text.hpp"

namespace sim {
namespace {

using Json = nlohmann::ordered_json;

std::string number(double value) {
  return std::isfinite(value) ? fmt::format("{:.4g}", value) : "-";
}

/// How a deviation is told: per cent of what a logarithmic axis shows, else the axis's own unit.
std::string deviation_unit(const FigureFacts& figure) {
  if (figure.y.logarithmic) return "%";
  return unit_text(figure.y.unit);
}

std::string deviation_text(const FigureFacts& figure, double value) {
  constexpr double nothing = 1e-12;  // what rounding leaves
  if (!std::isfinite(value)) return "-";
  if (std::abs(value) < nothing) return "0";
  return figure.y.logarithmic ? fmt::format("{:+.1f}", 100 * value) : fmt::format("{:+.3g}", value);
}

/// Four columns, the first wide enough for its name.
std::string row(std::size_t first, const std::vector<std::string>& cells) {
  std::string line = fmt::format("  {:>{}}", cells.front(), first);
  for (std::size_t i = 1; i < cells.size(); ++i) line += fmt::format(" {:>12}", cells[i]);
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

std::string points_table(const Comparison& c) {
  const FigureFacts& figure = c.figure;
  const std::size_t first = std::max<std::size_t>(12, figure.x.name.size());
  std::string text =
      row(first, {figure.x.name, "data sheet", "model", "deviation"}) +
      row(first, {bracketed_unit(figure.x.unit), bracketed_unit(figure.y.unit),
                  bracketed_unit(figure.y.unit), bracketed_unit(deviation_unit(figure))});
  for (std::size_t i = 0; i < c.model.size(); ++i)
    text += row(first, {number(c.sheet.x[i]), number(c.sheet.y[i]), number(c.model[i]),
                        deviation_text(figure, c.deviation(i))});
  return text;
}

/// A deviation's magnitude with its unit: "14.4 %".
std::string magnitude(const FigureFacts& figure, double value) {
  std::string text = deviation_text(figure, value);
  if (text.starts_with('+')) text.erase(0, 1);
  const std::string unit = deviation_unit(figure);
  return unit.empty() ? text : text + " " + unit;
}

/// " (4.9 %)" beside a deviation that is no share itself.
std::string share_text(const Comparison& c) {
  const double share = c.median_share();
  return c.figure.y.logarithmic || !std::isfinite(share) ? ""
                                                         : fmt::format(" ({:.1f} %)", 100 * share);
}

std::string rms_line(const Comparison& c) {
  return fmt::format("  rms deviation {}, median {}{}, over {} of {} points\n",
                     magnitude(c.figure, c.rms_deviation()),
                     magnitude(c.figure, c.median_deviation()), share_text(c),
                     c.known_deviations().size(), c.model.size());
}

ChartAxis chart_axis(const FigureAxis& axis) {
  const std::string unit = bracketed_unit(axis.unit);
  return {axis.name + (unit.empty() ? "" : " " + unit), axis.logarithmic};
}

ChartCurve chart_curve(const char* name, const std::vector<double>& x,
                       const std::vector<double>& y) {
  ChartCurve curve{name, {}};
  for (std::size_t i = 0; i < x.size(); ++i) curve.points.push_back({x[i], y[i], y[i], y[i]});
  return curve;
}

Chart figure_chart(const Comparison& c) {
  return {.title = c.figure.name,
          .description = c.figure.title,
          .x = chart_axis(c.figure.x),
          .y = chart_axis(c.figure.y),
          .curves = {chart_curve("data sheet", c.sheet.x, c.sheet.y),
                     chart_curve("model", c.sheet.x, c.model)}};
}

std::string comparison_text(const Comparison& c) {
  return fmt::format("\n{}: {}\n  {}\n", c.figure.name, c.figure.title, c.sheet.source) +
         points_table(c) + rms_line(c) + chart_as_text(figure_chart(c));
}

/// "[0.05, 0.4 log-uniform] "
std::string bounds_text(const SheetNumber& number) {
  if (!number.bounds) return "";
  return fmt::format("[{:g}, {:g} {}] ", number.bounds->low, number.bounds->high,
                     distribution_name(number.bounds->distribution));
}

std::string source_text(const SheetNumber& number) {
  if (!number.source.empty()) return number.source;
  if (!number.bounds || number.bounds_reason.empty()) return "(default: the file does not say)";
  return fmt::format("(default: the file does not say; bounds: {})", number.bounds_reason);
}

std::string number_lines(const PartSheet& sheet) {
  std::string text;
  for (const SheetText& t : sheet.texts) text += fmt::format("  {:<24} {}\n", t.name, t.value);
  for (const SheetNumber& n : sheet.numbers)
    text +=
        fmt::format("  {:<24} {:<14} {}{}\n", n.name, with_unit(fmt::format("{}", n.value), n.unit),
                    bounds_text(n), source_text(n));
  return text;
}

std::string curve_lines(const PartSheet& sheet) {
  std::string text;
  for (const SheetCurve& c : sheet.curves)
    text += fmt::format("  {:<24} {:<14} {}\n", c.name, fmt::format("{} points", c.points.x.size()),
                        c.source);
  return text;
}

Json comparison_json(const Comparison& c) {
  Json json{{"name", c.figure.name}, {"title", c.figure.title}, {"source", c.sheet.source}};
  json["x"] = {{"name", c.figure.x.name}, {"unit", c.figure.x.unit}, {"values", c.sheet.x}};
  json["y"] = {{"name", c.figure.y.name}, {"unit", c.figure.y.unit}};
  json["data_sheet"] = c.sheet.y;
  json["model"] = c.model;
  json["rms_deviation"] = c.rms_deviation();
  json["median_deviation"] = c.median_deviation();
  json["median_share"] = c.median_share();
  json["deviation_unit"] = c.figure.y.logarithmic ? "1" : c.figure.y.unit;
  return json;
}

Json part_json(const PartSheet& part) {
  return {{"kind", part.kind},
          {"name", part.name},
          {"summary", part.summary},
          {"file", part.path.generic_string()}};
}

std::string dumped(const Json& json) { return json_page(json) + "\n"; }

/// Null where the number is known.
Json bounds_json(const SheetNumber& number) {
  if (!number.bounds) return nullptr;
  return {{"low", number.bounds->low},
          {"high", number.bounds->high},
          {"distribution", distribution_name(number.bounds->distribution)}};
}

}  // namespace

std::string parts_table(const std::vector<PartSheet>& parts) {
  std::size_t widest = 4;
  for (const PartSheet& part : parts) widest = std::max(widest, part.name.size());
  std::string text = fmt::format("{:<10}  {:<{}}  {}\n", "kind", "name", widest, "what it is");
  for (const PartSheet& part : parts)
    text += fmt::format("{:<10}  {:<{}}  {}\n", part.kind, part.name, widest, part.summary);
  return text;
}

std::string parts_json(const std::vector<PartSheet>& parts) {
  Json json = Json::array();
  for (const PartSheet& part : parts) json.push_back(part_json(part));
  return dumped({{"parts", json}});
}

std::string sheet_text(const PartSheet& sheet) {
  std::string text = fmt::format("{} {}: {}\n", sheet.kind, sheet.name, sheet.summary);
  for (const std::string& line : sheet.about) text += "  " + line + "\n";
  text += fmt::format("  {}\n\n", sheet.path.generic_string());
  text += number_lines(sheet) + curve_lines(sheet);
  if (!sheet.comparisons.empty()) text += "\nThe model against the data sheet\n";
  for (const Comparison& c : sheet.comparisons) text += comparison_text(c);
  return text;
}

std::string sheet_json(const PartSheet& sheet) {
  Json json = part_json(sheet);
  json["about"] = sheet.about;
  for (const SheetText& t : sheet.texts) json[t.name] = t.value;
  json["numbers"] = Json::object();
  for (const SheetNumber& n : sheet.numbers)
    json["numbers"][n.name] = {{"value", n.value},
                               {"unit", n.unit},
                               {"long_name", n.long_name},
                               {"source", n.source.empty() ? Json(nullptr) : Json(n.source)},
                               {"bounds", bounds_json(n)}};
  json["curves"] = Json::object();
  for (const SheetCurve& c : sheet.curves)
    json["curves"][c.name] = {{"long_name", c.long_name},
                              {"source", c.source},
                              {"x", {{"name", c.x_name}, {"unit", c.x_unit}}},
                              {"y", {{"name", c.y_name}, {"unit", c.y_unit}}},
                              {"points", {{c.x_name, c.points.x}, {c.y_name, c.points.y}}}};
  json["figures"] = Json::array();
  for (const Comparison& c : sheet.comparisons) json["figures"].push_back(comparison_json(c));
  return dumped(json);
}

}  // namespace sim
