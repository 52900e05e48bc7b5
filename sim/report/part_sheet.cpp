#include "sim/report/part_sheet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <future>
#include <limits>
#include <sstream>

#include "sim/counting/sample_quantile.hpp"
#include "sim/failure.hpp"
#include "sim/scenario/entries.hpp"
#include "sim/scenario/keys.hpp"

namespace sim {
namespace {

namespace fs = std::filesystem;
using channel::EmitterData;
using channel::ModuleData;

std::vector<std::string> opening_comment(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line) && line.starts_with("# ");)
    lines.push_back(line.substr(2));
  return lines;
}

std::string text_of(const std::vector<Entry>& entries, const std::string& key) {
  const auto at = std::ranges::find(entries, key, &Entry::key);
  return at == entries.end() ? "" : std::get<std::string>(at->value);
}

/// Of an item of the file, or the part whose item it is.
std::string source_of(const std::vector<Entry>& entries, const std::string& item) {
  const std::string source = text_of(entries, item + ".source"), like = text_of(entries, "like");
  return source.empty() && !like.empty() ? "as " + like : source;
}

/// The curve that a part names for a figure lies in curves/ beside the part's own folder.
DigitisedCurve curve_of(const Entry& entry, const fs::path& part) {
  const std::string& name = std::get<std::string>(entry.value);
  const fs::path file = name + ".csv";
  if (file.has_parent_path())
    throw bad_input(entry.key + " " + entry.place, "not the bare name of a curve",
                    "name a file in curves/ without its .csv");
  return read_digitised_curve(part.parent_path().parent_path() / "curves" / file);
}

template <class Data>
Comparison compare(const Figure<Data>& figure, const Data& data, DigitisedCurve sheet) {
  Comparison comparison{figure.facts, std::move(sheet), {}};
  for (const double x : comparison.sheet.x) comparison.model.push_back(figure.model(data, x));
  return comparison;
}

/// All figures at once: each is work of its own.
template <class Data>
std::vector<Comparison> compare_all(const std::vector<Figure<Data>>& figures, const Data& data,
                                    const std::vector<Entry>& entries, const fs::path& part) {
  std::vector<std::future<Comparison>> under_way;
  for (const auto& figure : figures) {
    const auto at = std::ranges::find(entries, "figures." + figure.facts.name, &Entry::key);
    if (at == entries.end()) continue;
    under_way.push_back(std::async(std::launch::async, compare<Data>, std::cref(figure),
                                   std::cref(data), curve_of(*at, part)));
  }
  std::vector<Comparison> all;
  for (auto& one : under_way) all.push_back(one.get());
  return all;
}

std::string khz(double hz) { return fmt::format("{:g} kHz", hz / 1e3); }

std::string agc_summary(const ModuleData& m) {
  if (m.agc_attack_db_per_ms == 0) return "fixed gain";
  const std::string limit = m.agc_long_burst_ms > 0
                                ? fmt::format("{:g} ms", m.agc_long_burst_ms)
                                : fmt::format("{:g} cycles", m.agc_long_burst_cycles);
  const std::string rule = m.agc_hold_ms > 0
                               ? fmt::format("gaps of {:g} ms", m.agc_hold_ms)
                               : fmt::format("a duty of {:g} at most", m.agc_max_duty);
  const std::string free =
      m.agc_free_cycles > 0 ? fmt::format(", {:g} cycles aside", m.agc_free_cycles) : "";
  return fmt::format("AGC: bursts beyond {} need {}{}", limit, rule, free);
}

std::string summary_of(const ModuleData& m) {
  if (channel::is_matched(m)) return m.detector + " matched receiver, for validation";
  return fmt::format("{}, Emin {:g} mW/m2, {}", khz(m.centre_hz), m.emin_mw_per_m2, agc_summary(m));
}

/// Angle to half intensity in degrees.
double half_angle(const EmitterData& led) {
  double low = 0, high = 90;
  while (high - low > 0.01) {
    const double middle = (low + high) / 2;
    (channel::relative_intensity(led, dsp::degrees(middle)) > 0.5 ? low : high) = middle;
  }
  return high;
}

std::string summary_of(const EmitterData& led) {
  const double ma = std::min(100.0, led.intensity_mw_per_sr.x.back());
  return fmt::format(
      "{:g} nm, {:.3g} mW/sr at {:g} mA, half of it at {:.3g} degrees", led.wavelength_nm,
      1e3 * channel::axial_intensity(led, dsp::Amperes(ma * 1e-3)).value, ma, half_angle(led));
}

std::string summary_of(const channel::Floor& floor) {
  const std::string metal = floor.metal_reflectance > 0
                                ? fmt::format(", metal reflectance {:g}", floor.metal_reflectance)
                                : "";
  return fmt::format("index {:g}, roughness {:g} um, diffuse reflectance {:g}{}",
                     floor.refractive_index, floor.roughness_um, floor.diffuse_reflectance, metal);
}

std::string summary_of(const channel::PhotodiodeData& diode) {
  return fmt::format("{:g} mm2, {:g} A/W", diode.area_mm2, diode.responsivity_a_per_w);
}

template <class Data>
std::optional<channel::NumberBounds> bounds_of(const Data& data, const std::string& number) {
  const auto at = std::ranges::find(data.bounds, number, &channel::NumberBounds::number);
  return at == data.bounds.end() ? std::nullopt : std::optional(*at);
}

template <class Data>
void add_keys(PartSheet& sheet, const PartKeys<Data>& keys, const Data& data,
              const std::vector<Entry>& entries) {
  for (const auto& c : keys.choices)
    sheet.texts.push_back({c.facts.name, data.*c.member, c.facts.long_name});
  for (const auto& n : keys.numbers)
    if (n.facts.range.contains(data.*n.member))  // else it stands for none
      sheet.numbers.push_back({n.facts.name, n.facts.unit, n.facts.long_name,
                               source_of(entries, n.facts.name), data.*n.member,
                               bounds_of(data, n.facts.name), n.unsaid ? n.unsaid->reason : ""});
  for (const auto& c : keys.curves)
    if (!(data.*c.member).empty())
      sheet.curves.push_back({c.name, c.long_name, source_of(entries, c.name), c.x.name, c.x.unit,
                              c.y.name, c.y.unit, data.*c.member});
}

template <class Data>
PartSheet sheet_of(const PartFile& file, const Part<Data>& part, const PartKeys<Data>& keys,
                   const std::vector<Figure<Data>>& figures, Compare whether) {
  const std::vector<Entry> entries = read_entries(part.source.text, file.path);
  PartSheet sheet{file.kind,
                  part.data.name,
                  file.path,
                  opening_comment(part.source.text),
                  summary_of(part.data),
                  {},
                  {},
                  {},
                  {}};
  add_keys(sheet, keys, part.data, entries);
  if (whether == Compare::yes)
    sheet.comparisons = compare_all(figures, part.data, entries, file.path);
  return sheet;
}

}  // namespace

double Comparison::deviation(std::size_t i) const {
  const double difference = model[i] - sheet.y[i];
  return figure.y.logarithmic ? difference / sheet.y[i] : difference;
}

std::vector<double> Comparison::known_deviations() const {
  std::vector<double> known;
  for (std::size_t i = 0; i < model.size(); ++i)
    if (std::isfinite(deviation(i))) known.push_back(std::abs(deviation(i)));
  return known;
}

double Comparison::rms_deviation() const {
  const auto known = known_deviations();
  double sum = 0;
  for (const double d : known) sum += d * d;
  return std::sqrt(sum / static_cast<double>(known.size()));
}

double Comparison::median_deviation() const { return sample_quantile(known_deviations(), 0.5); }

double Comparison::median_share() const {
  std::vector<double> shares;
  for (std::size_t i = 0; i < model.size(); ++i) {
    const double share = std::abs(model[i] / sheet.y[i] - 1);
    if (sheet.y[i] <= 0) return std::numeric_limits<double>::quiet_NaN();
    if (std::isfinite(share)) shares.push_back(share);
  }
  return sample_quantile(std::move(shares), 0.5);
}

PartSheet read_part_sheet(const PartFile& file, const PartRoots& folders, Compare whether) {
  PartSources from{{file.path.parent_path().parent_path()}, {}, {}};
  from.folders.insert(from.folders.end(), folders.begin(), folders.end());
  if (file.kind == module_keys().kind)
    return sheet_of(file, load_module(file.name, from, ""), module_keys(), module_figures(),
                    whether);
  if (file.kind == led_keys().kind)
    return sheet_of(file, load_led(file.name, from, ""), led_keys(), led_figures(), whether);
  if (file.kind == floor_keys().kind)
    return sheet_of(file, load_floor(file.name, from, ""), floor_keys(), {}, whether);
  return sheet_of(file, load_photodiode(file.name, from, ""), photodiode_keys(), {}, whether);
}

}  // namespace sim
