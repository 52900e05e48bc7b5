#include "sim/scenario/text_axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "sim/failure.hpp"
#include "sim/scenario/disturbance_keys.hpp"
#include "sim/scenario/key_check.hpp"
#include "sim/text/list_text.hpp"

namespace sim {
namespace {

constexpr const char* how_to_list = "write a list, such as [\"A\", \"B\"] or A,B, or \"*\" for all";

void check_label(const Key& key, const std::string& label, const std::string& place) {
  const std::string problem = fmt::format("{} = \"{}\" {}", key.name(), label, place);
  if (label.empty()) throw bad_input(problem, "an empty name", how_to_list);
  check_text(key, label, place);
}

void refuse_commas(const Axis& axis, const std::string& place) {
  for (const std::string& label : axis.labels)
    if (label.find(',') != std::string::npos)
      throw bad_input(fmt::format("{} = \"{}\" {}", axis.key, label, place),
                      "a name with a comma cannot be swept", "rename it");
}

void refuse_equal_texts(const Axis& axis, const std::string& place) {
  std::vector<std::string> sorted = axis.labels;
  std::ranges::sort(sorted);
  const auto twin = std::ranges::adjacent_find(sorted);
  if (twin == sorted.end()) return;
  throw bad_input(fmt::format("{} = \"{}\" {}", axis.key, *twin, place), "twice in the same sweep",
                  "remove one of the two");
}

}  // namespace

bool is_sweepable_text(const Key& key) {
  if (!disturbance_of(key.name()).empty()) return false;  // its kind says which keys it has
  if (!key.swept) return false;
  return key.facts.type == KeyType::part || key.facts.type == KeyType::choice;
}

bool is_text_list(std::string_view text) {
  return trimmed(text) == all_texts || text.find(',') != std::string_view::npos;
}

std::vector<std::string> parse_texts(std::string_view text) {
  std::vector<std::string> texts;
  for (const std::string_view item : split(text, ',')) texts.emplace_back(trimmed(item));
  if (texts.back().empty()) texts.pop_back();  // "A," is a list of one
  return texts;
}

void set_labels(Axis& axis, std::vector<std::string> labels, const std::string& place) {
  if (labels.empty()) throw bad_input(axis.key + " " + place, "an empty sweep", how_to_list);
  axis.labels = std::move(labels);
  refuse_commas(axis, place);
  refuse_equal_texts(axis, place);
  axis.values.resize(axis.labels.size());
  std::iota(axis.values.begin(), axis.values.end(), 0);
}

Axis make_text_axis(const Key& key, const std::vector<std::string>& texts,
                    const std::string& place) {
  std::vector<std::string> labels;
  for (const std::string& text : texts) {
    const bool all_choices = text == all_texts && key.facts.type == KeyType::choice;
    if (all_choices)
      labels.insert(labels.end(), key.choices.begin(), key.choices.end());
    else
      labels.push_back(text);
    if (!all_choices) check_label(key, text, place);
  }
  Axis axis{key.name(), "", key.facts.long_name, {}};
  set_labels(axis, std::move(labels), place);
  return axis;
}

}  // namespace sim
