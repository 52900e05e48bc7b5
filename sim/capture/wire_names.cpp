#include "sim/capture/wire_names.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace sim {

std::string without_range(const std::string& name) {
  const auto open = name.rfind('[');
  if (!name.ends_with(']') || open == std::string::npos) return name;
  const std::string range = name.substr(open + 1, name.size() - open - 2);
  const std::string bit = range.substr(0, range.find(':'));
  return range == bit + ":" + bit ? name.substr(0, open) : name;
}

void WireNames::enter(std::string_view scope) {
  std::string path = scopes_[open_.back()];
  path.append(scope).append(".");
  bytes_ += sizeof(std::string) + path.capacity();
  open_.push_back(scopes_.size());
  scopes_.push_back(std::move(path));
}

void WireNames::leave() {
  if (open_.size() > 1) open_.pop_back();
}

void WireNames::add(std::string name, std::size_t code) {
  variables_.push_back({std::move(name), open_.back(), code});
  const Variable& added = variables_.back();
  note_if_asked(added);
  // Of a variable, of its place in an order, and of its name in the list.
  bytes_ += sizeof(Variable) + 3 * sizeof(std::size_t) + sizeof(std::string) + added.name.size();
}

/// The place itself, or an end of it at a dot: "dut.rx" of top.dut.rx, but not "ut.rx".
void WireNames::note_if_asked(const Variable& variable) {
  const auto asked = scope_asked_for(variable);
  const std::string& scope = scopes_[variable.scope];
  if (!asked || asked->empty() || !("." + scope).ends_with("." + *asked)) return;
  if (*asked == scope && !asked_code_) asked_code_ = variable.code;
  ending_is_shared_ |= ending_code_.value_or(variable.code) != variable.code;
  if (!ending_code_) ending_code_ = variable.code;
}

std::string WireNames::path_of(const Variable& variable) const {
  return scopes_[variable.scope] + variable.name;
}

std::optional<std::string> WireNames::scope_asked_for(const Variable& variable) const {
  for (const std::string& name : {variable.name, without_range(variable.name)})
    if (asked_.ends_with(name)) return asked_.substr(0, asked_.size() - name.size());
  return std::nullopt;
}

/// The order of variables, of which those outside any scope go first.
bool WireNames::is_before(std::size_t a, std::size_t b) const {
  return std::pair(variables_[a].scope != 0, a) < std::pair(variables_[b].scope != 0, b);
}

std::vector<std::size_t> WireNames::by_name_and_code() const {
  std::vector<std::size_t> order(variables_.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, [this](std::size_t a, std::size_t b) {
    const auto& [name, scope, code] = variables_[a];
    const auto& [other_name, other_scope, other_code] = variables_[b];
    if (const auto names = name <=> other_name; names != 0) return names < 0;
    return code != other_code ? code < other_code : is_before(a, b);
  });
  return order;
}

/// The first variable of each name of each code, in the order of the file; behind them those whose
/// name others have too, by that name.
std::vector<WireNames::Listed> WireNames::chosen() const {
  std::vector<Listed> listed, shared;
  const std::vector<std::size_t> order = by_name_and_code();
  for (auto group = order.begin(); group != order.end();) {
    const auto& [name, scope, code] = variables_[*group];
    const auto end = std::find_if(group, order.end(), [&same = name, this](std::size_t i) {
      return variables_[i].name != same;
    });
    const bool several = variables_[*(end - 1)].code != code;
    const std::size_t first = *std::min_element(
        group, end, [this](std::size_t a, std::size_t b) { return is_before(a, b); });
    if (several && variables_[first].scope != 0) shared.push_back({first, false});
    for (std::size_t last = none; group != end; ++group)
      if (const std::size_t now = variables_[*group].code; std::exchange(last, now) != now)
        listed.push_back({*group, several});
  }
  std::ranges::sort(listed, {}, &Listed::variable);
  std::ranges::sort(shared, {}, &Listed::variable);
  listed.insert(listed.end(), shared.begin(), shared.end());
  return listed;
}

void WireNames::list_as(std::string name, std::size_t code) {
  if (first_.size() <= code) first_.resize(code + 1, none);
  next_.push_back(std::exchange(first_[code], list_.size()));
  list_.push_back(std::move(name));
}

void WireNames::finish() {
  for (const auto& [number, by_place] : chosen()) {
    const Variable& variable = variables_[number];
    list_as(by_place ? path_of(variable) : variable.name, variable.code);
  }
  variables_ = {};
  if (!asked_code_ && !ending_is_shared_) asked_code_ = ending_code_;
  if (asked_code_ && std::ranges::find(list_, asked_) == list_.end()) list_as(asked_, *asked_code_);
}

}  // namespace sim
