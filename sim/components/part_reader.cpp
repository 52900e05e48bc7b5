#include "sim/components/part_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <iterator>
#include <variant>
#include <vector>

#include "sim/failure.hpp"
#include "sim/scenario/entries.hpp"
#include "sim/scenario/key_check.hpp"
#include "sim/text/spelling.hpp"

namespace sim {
namespace {

constexpr const char* sibling_key = "like";

/// What one part file says, against the keys that it may have.
template <class Data>
class PartReader {
 public:
  PartReader(const PartKeys<Data>& keys, const std::string& text, const std::filesystem::path& path,
             const Data* sibling)
      : keys_(keys),
        file_("in " + path.generic_string()),
        entries_(read_entries(text, path)),
        sibling_(sibling) {}

  Data read(const std::string& stem) const {
    refuse_unknown();
    Data part = sibling_ != nullptr ? *sibling_ : Data{};
    part.name = text("name", "add name = \"" + stem + "\"");
    if (!same_name(part.name, stem))
      throw bad_input(fmt::format("name = \"{}\" {}", part.name, find("name")->place),
                      "the file has another name", "rename one of the two");
    for (const auto& choice : keys_.choices) read_choice(choice, part);
    for (const auto& number : keys_.numbers) read_number(number, part);
    for (const auto& curve : keys_.curves) read_curve(curve, part);
    if (needs_numbers(part))
      for (const auto& [one, other] : keys_.either) require_either(one, other, part);
    for (const auto& entry : entries_)
      if (entry.key.starts_with("figures.")) text(entry.key, "name a file in curves/");
    refuse_flaw(part);
    return part;
  }

 private:
  std::vector<std::string> known() const {
    std::vector<std::string> names{"name", sibling_key};
    for (const auto& c : keys_.choices) names.push_back(c.facts.name);
    for (const auto& n : keys_.numbers)
      for (const char* leaf : {".value", ".low", ".high", ".distribution", ".source"})
        names.push_back(n.facts.name + leaf);
    for (const auto& c : keys_.curves)
      for (const auto& leaf : {c.x.name, c.y.name, std::string("source")})
        names.push_back(c.name + "." + leaf);
    for (const auto& figure : keys_.figures) names.push_back("figures." + figure);
    return names;
  }

  void refuse_unknown() const {
    const auto names = known();
    for (const auto& entry : entries_) {
      refuse_bare_number(entry);
      if (std::ranges::find(names, entry.key) == names.end())
        throw bad_input(entry.key + " " + entry.place, "no such key in a part file",
                        "did you mean " + likely_name(entry.key, names) + "?");
    }
  }

  /// Of an item that there is the likeliest key, else the likeliest item.
  static std::string likely_name(const std::string& key, const std::vector<std::string>& names) {
    const auto item_of = [](const std::string& name) { return name.substr(0, name.find('.')); };
    std::vector<std::string> items;
    std::ranges::transform(names, std::back_inserter(items), item_of);
    const bool is_there = std::ranges::find(items, item_of(key)) != items.end();
    return is_there ? nearest(key, names) : nearest(item_of(key), items);
  }

  void refuse_flaw(const Data& part) const {
    const char* flaw = keys_.flaw ? keys_.flaw(part) : nullptr;
    if (flaw) throw bad_input(part.name + " " + file_, flaw, "correct the part's file");
  }

  void refuse_bare_number(const Entry& entry) const {
    for (const auto& n : keys_.numbers)
      if (n.facts.name == entry.key)
        throw bad_input(
            entry.key + " " + entry.place, "a number without its source",
            "write " + entry.key + " = { value = NUMBER, source = \"document, page\" }");
  }

  const Entry* find(const std::string& key) const {
    const auto at = std::ranges::find(entries_, key, &Entry::key);
    return at == entries_.end() ? nullptr : &*at;
  }

  template <class Wanted>
  const Wanted& get(const std::string& key, const char* wanted, const std::string& remedy) const {
    const Entry* entry = find(key);
    if (!entry) throw bad_input(key + " " + file_, "missing", remedy);
    const auto* value = std::get_if<Wanted>(&entry->value);
    if (!value)
      throw bad_input(key + " " + entry->place,
                      fmt::format("{} where {} is expected", kind_of(entry->value), wanted),
                      remedy);
    return *value;
  }

  const std::string& text(const std::string& key, const std::string& remedy) const {
    const std::string& value = get<std::string>(key, "text", remedy);
    if (value.empty()) throw bad_input(key + " " + find(key)->place, "empty", remedy);
    return value;
  }

  bool has_any(const std::string& name) const {
    return std::ranges::any_of(entries_,
                               [&](const Entry& e) { return e.key.starts_with(name + "."); });
  }

  /// Whether the file has the item; it must then name its source.
  bool present(const std::string& name, const std::string& sample, bool required) const {
    if (!has_any(name)) {
      if (!required) return false;
      throw bad_input(name + " " + file_, "missing, and no default can be right", "add " + sample);
    }
    require_source(name);
    return true;
  }

  /// The one that is given takes the place of the other of a sibling.
  void require_either(const std::string& one, const std::string& other, Data& part) const {
    const bool both = has_any(one) && has_any(other);
    if (sibling_ != nullptr && has_any(one) && !both) return reset(other, part);
    if (sibling_ != nullptr && has_any(other) && !both) return reset(one, part);
    if (has_any(one) != has_any(other) || (sibling_ != nullptr && !both)) return;
    throw bad_input(fmt::format("{} and {} {}", one, other, file_),
                    both ? "both are given" : "both are missing",
                    both ? "remove one of the two" : "add one of the two");
  }

  /// A number or a curve, to what it is of a part of which nothing is known.
  void reset(const std::string& name, Data& part) const {
    for (const auto& number : keys_.numbers)
      if (number.facts.name == name) part.*number.member = Data{}.*number.member;
    for (const auto& curve : keys_.curves)
      if (curve.name == name) part.*curve.member = Data{}.*curve.member;
    forget_bounds(name, part);
  }

  static void forget_bounds(const std::string& number, Data& part) {
    std::erase_if(part.bounds, [&](const auto& bounds) { return bounds.number == number; });
  }

  void require_source(const std::string& name) const {
    const std::string remedy = "add source = \"document, page\" to it";
    if (find(name + ".source")) return static_cast<void>(text(name + ".source", remedy));
    const auto first = std::ranges::find_if(
        entries_, [&](const Entry& e) { return e.key.starts_with(name + "."); });
    throw bad_input(name + " " + first->place, "without its source", remedy);
  }

  void read_choice(const PartChoice<Data>& choice, Data& part) const {
    const std::string& name = choice.facts.name;
    if (find(name) == nullptr) return;
    const std::string remedy =
        fmt::format("use {} = \"{}\"", name, fmt::join(choice.choices, "\" or \""));
    part.*choice.member = text(name, remedy);
    if (std::ranges::find(choice.choices, part.*choice.member) == choice.choices.end())
      throw bad_input(fmt::format("{} = \"{}\" {}", name, part.*choice.member, find(name)->place),
                      choice.facts.long_name + " is one of a list", remedy);
  }

  bool needs_numbers(const Data& part) const {
    return keys_.needs_numbers == nullptr || keys_.needs_numbers(part);
  }

  void read_number(const PartNumber<Data>& number, Data& part) const {
    const std::string& name = number.facts.name;
    const std::string sample = name + " = { value = NUMBER, source = \"document, page\" }";
    const bool is_alone = sibling_ == nullptr && needs_numbers(part);
    if (!present(name, sample, number.required && is_alone)) {
      if (number.unsaid && is_alone) part.bounds.push_back(number.unsaid->bounds);
      return;
    }
    forget_bounds(name, part);
    part.*number.member = number_at(number.facts, "value", "write " + sample);
    read_bounds(number, part);
  }

  /// A number of an item, "centre_hz.low"; its value is called as the item is.
  double number_at(KeyFacts facts, const std::string& leaf, const std::string& remedy) const {
    const std::string key = facts.name + "." + leaf;
    const double value = get<double>(key, "a number", remedy);
    if (leaf != "value") facts.name = key;
    check_number(facts, value, find(key)->place);
    return value;
  }

  /// Both of an item's bounds, or neither.
  void read_bounds(const PartNumber<Data>& number, Data& part) const {
    const std::string& name = number.facts.name;
    const Entry* distribution = find(name + ".distribution");
    if (!find(name + ".low") && !find(name + ".high")) {
      if (distribution)
        throw bad_input(distribution->key + " " + distribution->place, "nothing to distribute",
                        "add low and high");
      return;
    }
    const std::string remedy = "add low and high, or neither";
    const channel::NumberBounds bounds{.number = name,
                                       .low = number_at(number.facts, "low", remedy),
                                       .high = number_at(number.facts, "high", remedy),
                                       .distribution = distribution_of(name),
                                       .is_measured = source_begins(name, source_of_measured),
                                       .breaks_rule = source_begins(name, source_of_misfit)};
    check_bounds(bounds, part.*number.member);
    part.bounds.push_back(bounds);
  }

  bool source_begins(const std::string& name, std::string_view words) const {
    return get<std::string>(name + ".source", "a text", "name document and page")
        .starts_with(words);
  }

  channel::Distribution distribution_of(const std::string& name) const {
    const std::string key = name + ".distribution";
    const Entry* entry = find(key);
    if (!entry) return channel::Distribution::uniform;
    const auto all = channel::distributions();
    std::vector<std::string_view> names;
    for (const auto& known : all) names.push_back(known.name);
    const std::string remedy = fmt::format("use \"{}\"", fmt::join(names, "\" or \""));
    const std::string& word = text(key, remedy);
    const auto found = std::ranges::find(all, word, &channel::DistributionName::name);
    if (found == all.end())
      throw bad_input(fmt::format("{} = \"{}\" {}", key, word, entry->place),
                      "no such distribution", remedy);
    return found->distribution;
  }

  void check_bounds(const channel::NumberBounds& bounds, double value) const {
    const Entry* low = find(bounds.number + ".low");
    if (bounds.low > value || value > bounds.high)
      throw bad_input(
          fmt::format("{} = {} to {} {}", bounds.number, bounds.low, bounds.high, low->place),
          fmt::format("the value {} is not between them", value), "correct value, low or high");
    if (bounds.distribution == channel::Distribution::log_uniform && bounds.low <= 0)
      throw bad_input(fmt::format("{} = {} {}", low->key, bounds.low, low->place),
                      "the logarithm of 0 has no bound", "raise it or use \"uniform\"");
  }

  void read_curve(const PartCurve<Data>& curve, Data& part) const {
    const std::string sample =
        fmt::format("{} = {{ {} = [...], {} = [...], source = \"document, figure\" }}", curve.name,
                    curve.x.name, curve.y.name);
    if (!present(curve.name, sample, curve.required && sibling_ == nullptr)) return;
    part.*curve.member = {axis(curve.name, curve.x, sample), axis(curve.name, curve.y, sample)};
    check_shape(curve, part.*curve.member);
  }

  std::vector<double> axis(const std::string& curve, KeyFacts facts,
                           const std::string& sample) const {
    facts.name = curve + "." + facts.name;
    const auto& values =
        get<std::vector<double>>(facts.name, "a list of numbers", "write " + sample);
    for (const double value : values) check_number(facts, value, find(facts.name)->place);
    return values;
  }

  void check_shape(const PartCurve<Data>& curve, const channel::Curve& points) const {
    const std::string at = curve.name + " " + find(curve.name + "." + curve.x.name)->place;
    if (points.x.size() != points.y.size())
      throw bad_input(at,
                      fmt::format("{} has {} values, {} has {}", curve.x.name, points.x.size(),
                                  curve.y.name, points.y.size()),
                      "give both lists the same length");
    if (points.x.size() < 2) throw bad_input(at, "a curve has at least two points", "add points");
    if (std::ranges::adjacent_find(points.x, std::greater_equal<>()) != points.x.end())
      throw bad_input(at, curve.x.name + " must increase from point to point", "sort the points");
  }

  const PartKeys<Data>& keys_;
  std::string file_;
  std::vector<Entry> entries_;
  const Data* sibling_;
};

}  // namespace

bool same_name(const std::string& a, const std::string& b) {
  return std::ranges::equal(
      a, b, [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

std::optional<SiblingName> sibling_of(const std::string& text, const std::filesystem::path& path) {
  const std::vector<Entry> entries = read_entries(text, path);
  const auto entry = std::ranges::find(entries, sibling_key, &Entry::key);
  if (entry == entries.end()) return std::nullopt;
  const auto* name = std::get_if<std::string>(&entry->value);
  if (name == nullptr)
    throw bad_input(entry->key + " " + entry->place,
                    fmt::format("{} where text is expected", kind_of(entry->value)),
                    "name a part, as like = \"TSOP94256\"");
  return SiblingName{*name, entry->place};
}

template <class Data>
Data read_part_text(const PartKeys<Data>& keys, const std::string& text,
                    const std::filesystem::path& path, const std::string& stem,
                    const Data* sibling) {
  return PartReader<Data>(keys, text, path, sibling).read(stem);
}

template channel::ModuleData read_part_text(const PartKeys<channel::ModuleData>&,
                                            const std::string&, const std::filesystem::path&,
                                            const std::string&, const channel::ModuleData*);
template channel::EmitterData read_part_text(const PartKeys<channel::EmitterData>&,
                                             const std::string&, const std::filesystem::path&,
                                             const std::string&, const channel::EmitterData*);
template channel::Floor read_part_text(const PartKeys<channel::Floor>&, const std::string&,
                                       const std::filesystem::path&, const std::string&,
                                       const channel::Floor*);
template channel::PhotodiodeData read_part_text(const PartKeys<channel::PhotodiodeData>&,
                                                const std::string&, const std::filesystem::path&,
                                                const std::string&, const channel::PhotodiodeData*);

}  // namespace sim
