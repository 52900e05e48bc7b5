#include "sim/picture/style_sheet.hpp"

#include <algorithm>
#include <stdexcept>

#include "sim/text/list_text.hpp"
#include "sim/text/number_text.hpp"

namespace sim {
namespace {

[[noreturn]] void refuse(std::string_view what) {
  throw std::logic_error("a drawing's style sheet says \"" + std::string(what) + "\"");
}

std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> words = split(text, ' ');
  std::erase(words, "");
  return words;
}

double number_of(std::string_view text) {
  const std::optional<double> number = parse_number(text);
  if (!number) refuse(text);
  return *number;
}

/// "12px".
double pixels_of(std::string_view text) {
  if (!text.ends_with("px")) refuse(text);
  return number_of(text.substr(0, text.size() - 2));
}

/// "#0072b2" or "#999".
std::uint32_t rgb_of(const std::string& text) {
  const bool is_short = text.size() == 4;
  if ((!is_short && text.size() != 7) || text[0] != '#' ||
      text.find_first_not_of("0123456789abcdef", 1) != std::string::npos)
    refuse(text);
  std::string digits;
  for (const char digit : text.substr(1)) digits += std::string(is_short ? 2 : 1, digit);
  return static_cast<std::uint32_t>(std::stoul(digits, nullptr, 16));
}

std::vector<double> dashes_of(const std::string& text) {
  std::vector<double> dashes;
  if (text == "none") return dashes;
  for (const std::string_view word : words_of(text)) dashes.push_back(number_of(word));
  return dashes;
}

/// Where no rule says otherwise: as SVG has it.
const SvgProperties& usual_properties() {
  static const SvgProperties usual{
      {"background", "#fff"},   {"color", "#000"},        {"fill", "#000"},
      {"fill-opacity", "1"},    {"stroke", "none"},       {"stroke-opacity", "1"},
      {"stroke-width", "1"},    {"text-anchor", "start"}, {"stroke-dasharray", "none"},
      {"font-family", "serif"}, {"font-size", "16px"},    {"font-weight", "normal"}};
  return usual;
}

/// "bold 13px monospace"
void set_font(SvgProperties& properties, std::string_view font) {
  const std::vector<std::string_view> words = words_of(font);
  if (words.size() < 2 || words.size() > 3) refuse(font);
  properties["font-family"] = words.back();
  properties["font-size"] = words[words.size() - 2];
  properties["font-weight"] = words.size() == 3 ? words.front() : "normal";
}

SvgProperties properties_in(std::string_view declarations) {
  SvgProperties properties;
  for (const std::string_view declaration : split(declarations, ';')) {
    const std::size_t colon = declaration.find(':');
    if (colon == std::string_view::npos) continue;
    const std::string_view name = trimmed(declaration.substr(0, colon));
    const std::string_view value = trimmed(declaration.substr(colon + 1));
    if (name == "font")
      set_font(properties, value);
    else if (usual_properties().contains(name))
      properties[std::string(name)] = value;
    else
      refuse(declaration);
  }
  return properties;
}

std::optional<SvgInk> ink_of(const SvgProperties& properties, const std::string& of) {
  std::string colour = properties.at(of);
  if (colour == "none") return std::nullopt;
  if (colour == "currentColor") colour = properties.at("color");
  return SvgInk{rgb_of(colour), number_of(properties.at(of + "-opacity"))};
}

}  // namespace

StyleSheet::StyleSheet(std::string css) {
  css.resize(std::min(css.find("@media"), css.size()));
  std::ranges::replace(css, '\n', ' ');
  for (const std::string_view rule : split(css, '}')) {
    const std::size_t brace = rule.find('{');
    if (brace == std::string_view::npos) continue;
    for (const std::string_view selector : split(rule.substr(0, brace), ',')) {
      const std::string name(trimmed(selector));
      if (name.find_first_of(" >+~:[#.", 1) != std::string::npos) refuse(name);
      rules_.push_back({name, properties_in(rule.substr(brace + 1))});
    }
  }
}

/// What stands further down in the sheet has the last word.
void StyleSheet::overlay(SvgProperties& properties,
                         const std::vector<std::string>& selectors) const {
  for (const Rule& rule : rules_)
    if (std::ranges::find(selectors, rule.selector) != selectors.end())
      for (const auto& [name, value] : rule.properties) properties[name] = value;
}

/// A class has the last word over an element, and that over what it inherits of the whole.
SvgLook StyleSheet::look_of(std::string_view element, std::string_view classes) const {
  std::vector<std::string> selectors;
  for (const std::string_view name : words_of(classes))
    selectors.push_back("." + std::string(name));
  SvgProperties properties = usual_properties();
  overlay(properties, {"svg"});
  overlay(properties, {std::string(element)});
  overlay(properties, selectors);
  return {.fill = ink_of(properties, "fill"),
          .stroke = ink_of(properties, "stroke"),
          .stroke_width = number_of(properties["stroke-width"]),
          .dashes = dashes_of(properties["stroke-dasharray"]),
          .anchor = properties["text-anchor"],
          .font_family = properties["font-family"],
          .font_size = pixels_of(properties["font-size"]),
          .is_bold = properties["font-weight"] == "bold"};
}

SvgInk StyleSheet::paper() const {
  SvgProperties properties = usual_properties();
  overlay(properties, {"svg"});
  return {rgb_of(properties["background"]), 1};
}

}  // namespace sim
