#include "sim/guard/guard_check.hpp"

#include <fmt/format.h>

#include <set>

#include "protocol/shared_node.hpp"
#include "sim/arena/arena_check.hpp"
#include "sim/failure.hpp"
#include "sim/loading/point_scenario.hpp"
#include "sim/scenario/sweep.hpp"

namespace sim {
namespace {

std::string first_word(const std::string& message) { return message.substr(0, message.find(' ')); }

[[noreturn]] void refuse_messages(const Sender& sender, const std::string& message,
                                  const std::string& why, const std::string& suggestion) {
  throw bad_input(fmt::format("devices.{}.messages = \"{}\"", sender.kind, message), why,
                  suggestion);
}

/// "By convention the first word identifies the device": it names its variable.
std::string variable_of(const Sender& sender) {
  std::string name = first_word(sender.messages.front());
  for (const std::string& message : sender.messages) {
    if (first_word(message) != name || name.empty())
      refuse_messages(sender, message, "its first word is the name by which the guard knows it",
                      "begin all messages of a device with one word");
    if (const auto problem = protocol::problem_in_text(message))
      refuse_messages(sender, message, "SharedLink cannot carry it: " + *problem,
                      "use other characters");
  }
  return name;
}

std::vector<std::string> names_of_variables(const std::vector<Sender>& senders) {
  std::vector<std::string> names;
  std::set<std::string> seen;
  for (const Sender& sender : senders) {
    names.push_back(variable_of(sender));
    if (!seen.insert(names.back()).second)
      refuse_messages(sender, sender.messages.front(),
                      "another device's messages begin with this word too",
                      "give each a word of its own; {} is its number");
  }
  return names;
}

void check_list(const std::vector<std::string>& variables, const std::vector<Sender>& senders) {
  protocol::SharedNode node({.outbound = variables});
  for (std::size_t i = 0; i < senders.size(); ++i)
    for (const std::string& message : senders[i].messages)
      if (const auto problem = node.set(
              i,
              message +
                  std::string(senders[i].source == MessageSource::counter ? counter_size : 0, '0')))
        refuse_messages(senders[i], message, "no value of a shared list: " + *problem,
                        "shorten it");
}

}  // namespace

std::vector<std::string> shared_variables(const std::vector<Sender>& senders) {
  std::vector<std::string> variables = names_of_variables(senders);
  check_list(variables, senders);
  return variables;
}

void check_guard(const LoadedScenario& scenario) {
  check_arena(scenario);
  for (std::size_t i = 0; i < count_points(scenario.sweep); ++i)
    shared_variables(make_senders(point_scenario(scenario, point_coordinates(scenario.sweep, i))));
}

}  // namespace sim
