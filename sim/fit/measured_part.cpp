#include "sim/fit/measured_part.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <sstream>

#include "sim/components/part_reader.hpp"
#include "sim/scenario/entries.hpp"
#include "sim/scenario/keys.hpp"
#include "sim/text/existing_file.hpp"
#include "sim/text/rounded_text.hpp"

namespace sim {
namespace {

using channel::ModuleData;
using channel::NumberBounds;

constexpr std::string_view part_heading = "# Measured by cosys-sim fit: ";
constexpr int part_digits = 6;

/// Sources of a module's numbers and curves: of its own file, else of the parts that it is like.
class PartFileSources {
 public:
  explicit PartFileSources(const Part<ModuleData>& part) {
    add(part.source);
    std::for_each(part.siblings.rbegin(), part.siblings.rend(),
                  [this](const CarriedPart& sibling) { add(sibling); });
  }

  /// Nothing of what no file gives.
  std::optional<std::string> of(const std::string& item) const {
    for (const std::vector<Entry>& entries : files_) {
      const auto entry = std::ranges::find(entries, item + ".source", &Entry::key);
      if (entry != entries.end()) return std::get<std::string>(entry->value);
    }
    return std::nullopt;
  }

 private:
  void add(const CarriedPart& file) { files_.push_back(read_entries(file.text, file.file)); }

  std::vector<std::vector<Entry>> files_;
};

/// "# " before each line, none longer than most.
std::string comment_of(const std::string& text) {
  constexpr std::size_t most = 118;
  std::istringstream words(text);
  std::string lines, line = "#";
  for (std::string word; words >> word; line += " " + word)
    if (line.size() + 1 + word.size() > most) {
      lines += line + "\n";
      line = "#";
    }
  return lines + line + "\n";
}

std::string part_head(const FittedModule& fit, const std::string& like, const std::string& capture,
                      const std::string& remark) {
  const std::vector<std::string> told = number_names(fit, true), untold = number_names(fit, false);
  const std::string heading =
      fmt::format("{}a unit like {}, recorded in {}.", part_heading.substr(2), like, capture);
  std::string text = comment_of(heading);
  text += comment_of(
      told.empty() ? "No number is measured."
                   : "Measured, each with its interval of 95 %: " + list_in_words(told) + ".");
  if (!untold.empty())
    text += comment_of("Hardly told, what fits best: " + list_in_words(untold) + ".");
  text += comment_of("All others are those of " + like + ".");
  if (!remark.empty()) text += comment_of(remark);
  for (const std::string& line : fit.not_apart) text += comment_of("Not told apart: " + line + ".");
  for (const FitMisfit& misfit : fit.misfits)
    text += comment_of("The part does not follow the rule: " + misfit_words(misfit) + ".");
  return text;
}

const NumberBounds* bounds_in(const channel::AllBounds& all, const std::string& number) {
  const auto found = std::ranges::find(all, number, &NumberBounds::number);
  return found == all.end() ? nullptr : &*found;
}

/// How a measured number's interval is drawn from: as what is known of such numbers.
channel::Distribution distribution_for(const PartNumber<ModuleData>& number, const ModuleData& like,
                                       double low) {
  const NumberBounds* bounds = bounds_in(like.bounds, number.facts.name);
  if (bounds == nullptr && number.unsaid) bounds = &number.unsaid->bounds;
  return bounds != nullptr && low > 0 ? bounds->distribution : channel::Distribution::uniform;
}

std::string bounds_text(const std::string& low, const std::string& high,
                        channel::Distribution distribution) {
  std::string text = fmt::format("low = {}, high = {}, ", low, high);
  if (distribution != channel::Distribution::uniform)
    text += fmt::format("distribution = \"{}\", ", channel::distribution_name(distribution));
  return text;
}

std::string number_line(const std::string& key, const std::string& value, const std::string& bounds,
                        const std::string& source) {
  return fmt::format("{} = {{ value = {}, {}source = {} }}\n", key, value, bounds,
                     toml_string(source));
}

/// The lines of a part's file, a number or curve each.
class MeasuredPartLines {
 public:
  MeasuredPartLines(const FittedModule& fit, const Part<ModuleData>& like,
                    const std::string& capture)
      : fit_(fit), like_(like), sources_(like), capture_(capture) {}

  std::string all() const {
    std::string text;
    for (const auto& number : module_keys().numbers) text += line_of_number(number);
    for (const auto& curve : module_keys().curves) text += lines_of_curve(curve);
    return text;
  }

 private:
  const FittedNumber* told(const std::string& key) const {
    const auto number = std::ranges::find(fit_.numbers, key, &FittedNumber::key);
    return number != fit_.numbers.end() && number->is_told ? &*number : nullptr;
  }

  /// Not where its interval is none, or the module like it says another number in its place.
  const FittedNumber* hardly_told(const std::string& key) const {
    const auto number = std::ranges::find(fit_.numbers, key, &FittedNumber::key);
    if (number == fit_.numbers.end() || number->low == number->high) return nullptr;
    const bool has_other = std::ranges::any_of(module_keys().either, [&](const auto& pair) {
      return (key == pair.first && sources_.of(pair.second)) ||
             (key == pair.second && sources_.of(pair.first));
    });
    return has_other ? nullptr : &*number;
  }

  /// The spread of units that a measured number has the place of.
  bool is_settled(const std::string& key) const {
    return (key == "centre_tolerance" && told("centre_hz") != nullptr) ||
           (key == "emin_max_mw_per_m2" && told("emin_mw_per_m2") != nullptr);
  }

  /// Of two of which a file gives one, the one whose place the other was measured in.
  bool is_replaced(const std::string& key) const {
    return std::ranges::any_of(module_keys().either, [&](const auto& pair) {
      return (key == pair.first && told(pair.second) != nullptr) ||
             (key == pair.second && told(pair.first) != nullptr);
    });
  }

  std::string line_of_number(const PartNumber<ModuleData>& number) const {
    const std::string& key = number.facts.name;
    if (is_settled(key)) return number_line(key, "0", "", "one unit was measured: no spread");
    if (is_replaced(key)) return "";
    if (const FittedNumber* measured = told(key)) return line_of_measured(number, *measured);
    if (const FittedNumber* best = hardly_told(key)) return line_of_best(number, *best);
    return line_as_like(number);
  }

  std::string line_of_measured(const PartNumber<ModuleData>& number,
                               const FittedNumber& measured) const {
    const auto text = [&](double value, Rounding rounding) {
      const Range& range = number.facts.range;
      return fmt::format("{}", std::stod(significant_text(std::clamp(value, range.low, range.high),
                                                          part_digits, rounding)));
    };
    const std::string bounds =
        bounds_text(text(measured.low, Rounding::down), text(measured.high, Rounding::up),
                    distribution_for(number, like_.data, measured.low));
    return number_line(
        number.facts.name, text(measured.value, Rounding::nearest), bounds,
        fmt::format("{}: {}, interval of 95 %",
                    fit_.misfits.empty() ? source_of_measured : source_of_misfit, capture_));
  }

  /// Nothing of what its files do not give, which is then what it is of any part.
  std::string line_as_like(const PartNumber<ModuleData>& number) const {
    const std::string& key = number.facts.name;
    const auto source = sources_.of(key);
    if (!source) return "";
    const NumberBounds* given = bounds_in(like_.data.bounds, key);
    const std::string bounds =
        given == nullptr ? ""
                         : bounds_text(fmt::format("{}", given->low),
                                       fmt::format("{}", given->high), given->distribution);
    return number_line(key, fmt::format("{}", like_.data.*number.member), bounds,
                       fmt::format("as {}: {}", like_.data.name, *source));
  }

  /// What fits best of what is hardly told, with bounds as far as the recording leaves them to any
  /// part. Another value would not go with the numbers that are told.
  std::string line_of_best(const PartNumber<ModuleData>& number, const FittedNumber& best) const {
    const NumberBounds* given = bounds_in(like_.data.bounds, best.key);
    const Range range = given == nullptr ? number.facts.range : Range{given->low, given->high};
    const double low = std::clamp(best.low, range.low, range.high);
    const double high = std::clamp(best.high, range.low, range.high);
    const auto text = [](double value) {
      return fmt::format("{}", std::stod(significant_text(value, part_digits, Rounding::nearest)));
    };
    return number_line(
        best.key, text(std::clamp(best.value, low, high)),
        bounds_text(text(low), text(high), distribution_for(number, like_.data, low)),
        fmt::format("hardly told by {}: what fits best, within what it leaves; {} has {}", capture_,
                    like_.data.name, like_.data.*number.member));
  }

  std::string lines_of_curve(const PartCurve<ModuleData>& curve) const {
    const channel::Curve& points = like_.data.*curve.member;
    const auto source = sources_.of(curve.name);
    if (points.empty() || !source) return "";
    return fmt::format("\n[{}]\n{} = [{}]\n{} = [{}]\nsource = {}\n", curve.name, curve.x.name,
                       fmt::join(points.x, ", "), curve.y.name, fmt::join(points.y, ", "),
                       toml_string(fmt::format("as {}: {}", like_.data.name, *source)));
  }

  const FittedModule& fit_;
  const Part<ModuleData>& like_;
  PartFileSources sources_;
  const std::string& capture_;
};

}  // namespace

std::string measured_part_text(const FittedModule& fit, const Part<ModuleData>& like,
                               const std::string& name, const std::string& capture,
                               const std::string& remark) {
  return part_head(fit, like.data.name, capture, remark) + "name = " + toml_string(name) + "\n\n" +
         MeasuredPartLines(fit, like, capture).all();
}

bool is_measured_part(const std::filesystem::path& path) {
  return beginning_of(path, part_heading.size()) == part_heading;
}

const std::string& unit_of_number(const std::string& key) {
  static const std::string none = "1";
  const auto& numbers = module_keys().numbers;
  const auto number = std::ranges::find(numbers, key, [](const auto& n) { return n.facts.name; });
  return number == numbers.end() ? none : number->facts.unit;
}

std::string list_in_words(const std::vector<std::string>& names) {
  if (names.size() < 2) return names.empty() ? "" : names.front();
  return fmt::format("{} and {}", fmt::join(names.begin(), names.end() - 1, ", "), names.back());
}

std::vector<std::string> number_names(const FittedModule& fit, bool are_told) {
  std::vector<std::string> names;
  for (const FittedNumber& number : fit.numbers)
    if (number.is_told == are_told) names.push_back(number.key);
  return names;
}

std::string misfit_words(const FitMisfit& misfit) {
  return misfit.what + ": " + misfit.by_how_much;
}

}  // namespace sim
