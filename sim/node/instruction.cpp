#include "sim/node/instruction.hpp"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "sim/failure.hpp"
#include "sim/text/spelling.hpp"

namespace sim {
namespace {

using Variables = std::vector<protocol::SharedVariable>;
using nlohmann::json;

constexpr auto how_to_write = "write Name=value or ?Name";

std::optional<std::size_t> find_variable(const Variables& list, const std::string& name) {
  const auto at = std::ranges::find(list, name, &protocol::SharedVariable::name);
  if (at == list.end()) return std::nullopt;
  return static_cast<std::size_t>(at - list.begin());
}

std::string suggestion(const Variables& list, const std::string& name) {
  if (list.empty()) return "this list of the node is empty";
  std::vector<std::string> names;
  for (const auto& variable : list) names.push_back(variable.name);
  return "did you mean " + nearest(name, names) + "?";
}

/// The place of an outbound variable that can have this value.
std::size_t find_settable(const protocol::SharedNode& node, const std::string& name,
                          const std::string& value) {
  const auto variable = find_variable(node.outbound(), name);
  if (!variable && find_variable(node.inbound(), name))
    throw bad_input("cannot set " + name, "it is inbound, the peer's to set",
                    "ask for it by ?" + name);
  if (!variable)
    throw bad_input("cannot set " + name, "no such outbound variable",
                    suggestion(node.outbound(), name));
  if (const auto problem = node.problem_in_value(*variable, value))
    throw bad_input("cannot set " + name, *problem, "it stays as it is");
  return *variable;
}

/// All of them or, if one cannot be, none.
void set(protocol::SharedNode& node, const std::map<std::string, std::string>& values) {
  std::vector<std::pair<std::size_t, std::string>> settable;
  for (const auto& [name, value] : values)
    settable.emplace_back(find_settable(node, name, value), value);
  for (const auto& [variable, value] : settable)
    [[maybe_unused]] const auto no_problem = node.set(variable, value);
}

void ask(protocol::SharedNode& node, const std::string& name) {
  const auto variable = find_variable(node.inbound(), name);
  if (!variable)
    throw bad_input("cannot ask for " + name, "no such inbound variable",
                    suggestion(node.inbound(), name));
  node.ask(*variable);
}

/// Names may have a = of their own, so the longest that fits is meant.
std::size_t end_of_name(const Variables& list, const std::string& line) {
  std::size_t longest = 0;
  for (const auto& variable : list)
    if (line.starts_with(variable.name + "=")) longest = std::max(longest, variable.name.size());
  return longest != 0 ? longest : line.find('=');
}

void obey_text(protocol::SharedNode& node, const std::string& line) {
  if (line.starts_with('?')) return ask(node, line.substr(1));
  const std::size_t equals = end_of_name(node.outbound(), line);
  if (equals == std::string::npos)
    throw bad_input("cannot read a line of stdin", "neither a value nor a question", how_to_write);
  set(node, {{line.substr(0, equals), line.substr(equals + 1)}});
}

bool is_object_of_texts(const json& object) {
  return object.is_object() &&
         std::ranges::all_of(object, [](const json& value) { return value.is_string(); });
}

void obey_json(protocol::SharedNode& node, const json& object) {
  const bool sets = object.size() == 1 && object.contains("set");
  const bool asks = object.size() == 1 && object.contains("ask");
  if (sets && is_object_of_texts(object["set"])) {
    set(node, object["set"].get<std::map<std::string, std::string>>());
  } else if (asks && object["ask"].is_string()) {
    ask(node, object["ask"]);
  } else {
    throw bad_input("cannot read a line of stdin", "a JSON object that means nothing here",
                    R"(write {"set": {"Name": "value"}} or {"ask": "Name"})");
  }
}

}  // namespace

void obey(protocol::SharedNode& node, const std::string& line) {
  if (line.empty()) return;
  if (line.size() > longest_instruction)
    throw bad_input("cannot read a line of stdin", "longer than 64 KiB", how_to_write);
  const json object = line.starts_with('{') ? json::parse(line, nullptr, false) : json();
  if (object.is_discarded())
    throw bad_input("cannot read a line of stdin", "it begins as JSON but is none", how_to_write);
  if (object.is_object()) return obey_json(node, object);
  obey_text(node, line);
}

}  // namespace sim
