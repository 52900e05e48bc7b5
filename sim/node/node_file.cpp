#include "sim/node/node_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>

#include "sim/failure.hpp"
#include "sim/scenario/entries.hpp"
#include "sim/scenario/key_check.hpp"
#include "sim/text/spelling.hpp"

namespace sim {
namespace {

using Settings = protocol::SharedNodeSettings;

constexpr std::string_view value_prefix = "values.";
constexpr std::size_t most_variables = 4096;
constexpr auto how_to_spell = "use printable ASCII without [, ] and |";

/// One row of the table of keys.
struct NodeKey {
  std::string name;
  std::function<void(NodeFile&, const Entry&)> take;
};

template <class Wanted>
const Wanted& expect(const Entry& entry, const char* wanted, const char* remedy) {
  if (const auto* value = std::get_if<Wanted>(&entry.value)) return *value;
  throw bad_input(entry.key + " " + entry.place,
                  fmt::format("{} where {} is expected", kind_of(entry.value), wanted), remedy);
}

NodeKey address_key(const char* name, char Settings::*member) {
  return {name, [=](NodeFile& file, const Entry& entry) {
            const auto& text = expect<std::string>(entry, "a letter", "write it as \"A\"");
            if (text.size() != 1 || !protocol::is_address(text[0]))
              throw bad_input(fmt::format("{} = \"{}\" {}", entry.key, text, entry.place),
                              "no address", "use one capital letter, \"A\" to \"P\"");
            file.settings.*member = text[0];
          }};
}

NodeKey number_key(const KeyFacts& facts, void (*set)(NodeFile&, double)) {
  return {facts.name, [=](NodeFile& file, const Entry& entry) {
            const double value = expect<double>(entry, "a number", "write it without quotes");
            check_number(facts, value, entry.place);
            set(file, value);
          }};
}

std::vector<std::string> names_in(const Entry& entry) {
  const auto* numbers = std::get_if<std::vector<double>>(&entry.value);
  if (numbers != nullptr && numbers->empty()) return {};
  const auto& names = expect<std::vector<std::string>>(
      entry, "a list of names", "write it as [\"AutoGpsLat\", \"AutoGpsLon\"]");
  if (names.size() > most_variables)
    throw bad_input(entry.key + " " + entry.place,
                    fmt::format("{} variables, {} at most", names.size(), most_variables),
                    "make the list shorter");
  return names;
}

NodeKey list_key(const char* name, std::vector<std::string> Settings::*member) {
  return {name, [=](NodeFile& file, const Entry& entry) {
            Settings alone;
            alone.*member = names_in(entry);
            alone.max_size = std::string::npos;
            if (const auto problem = protocol::problem_in_node(alone))
              throw bad_input(entry.key + " " + entry.place, *problem,
                              std::string("give each name once, and ") + how_to_spell);
            file.settings.*member = alone.*member;
          }};
}

NodeKey compressed_key() {
  return {"compressed", [](NodeFile& file, const Entry& entry) {
            file.settings.compressed = expect<bool>(entry, "true or false", "write it so");
          }};
}

const std::vector<NodeKey>& node_keys() {
  static const std::vector<NodeKey> keys{
      address_key("address", &Settings::address),
      address_key("peer", &Settings::peer),
      list_key("outbound", &Settings::outbound),
      list_key("inbound", &Settings::inbound),
      compressed_key(),
      number_key({"baud", "1/s", from(50, 4e6), "speed of the line", "", KeyType::whole_number},
                 [](NodeFile& file, double value) { file.baud = dsp::Hertz(value); }),
      number_key(
          {"full_set_period_s", "s", from(0.01, 86400), "time between full sets", ""},
          [](NodeFile& file, double value) { file.settings.full_set_every = dsp::Seconds(value); }),
      number_key(
          {"query_timeout_s", "s", from(0.01, 86400), "time to wait for an answer", ""},
          [](NodeFile& file, double value) { file.settings.query_timeout = dsp::Seconds(value); }),
      number_key({"send_period_s", "s", from(0.01, 3600), "time between messages", ""},
                 [](NodeFile& file, double value) { file.send_period = dsp::Seconds(value); }),
      number_key(
          {"max_size_bytes", "1", from(16, 4096), "longest message", "", KeyType::whole_number},
          [](NodeFile& file, double value) {
            file.settings.max_size = static_cast<std::size_t>(value);
          })};
  return keys;
}

bool is_empty_table(const Entry& entry) {
  const auto* other = std::get_if<OtherValue>(&entry.value);
  return entry.key == "values" && other != nullptr && other->what == "a table";
}

const NodeKey& known_key(const Entry& entry) {
  const auto& keys = node_keys();
  const auto at = std::ranges::find(keys, entry.key, &NodeKey::name);
  if (at != keys.end()) return *at;
  std::vector<std::string> names;
  for (const NodeKey& key : keys) names.push_back(key.name);
  throw bad_input(entry.key + " " + entry.place, "no such key",
                  "did you mean " + nearest(entry.key, names) + "?");
}

/// Key by key, but for the values, which need the lists. Where each key stands.
std::map<std::string, std::string> take_keys(NodeFile& file, const std::vector<Entry>& entries) {
  std::map<std::string, std::string> places;
  for (const Entry& entry : entries) {
    if (entry.key.starts_with(value_prefix) || is_empty_table(entry)) continue;
    known_key(entry).take(file, entry);
    places[entry.key] = entry.place;
  }
  return places;
}

void require_both_addresses(const std::map<std::string, std::string>& places,
                            const std::string& path) {
  for (const char* key : {"address", "peer"})
    if (!places.contains(key))
      throw bad_input(path, fmt::format("it does not say its {}", key),
                      fmt::format("add a line such as {} = \"A\"", key));
}

/// Of keys against each other; each alone has been checked.
void check_together(const NodeFile& file, const std::map<std::string, std::string>& places,
                    const std::string& path) {
  if (file.settings.address == file.settings.peer)
    throw bad_input(fmt::format("peer = \"{}\" {}", file.settings.peer, places.at("peer")),
                    "the node's own address", "give the other end's");
  if (file.settings.outbound.empty() && file.settings.inbound.empty())
    throw bad_input(path, "both lists are empty", "add outbound or inbound = [\"A_NAME\"]");
  if (const auto problem = protocol::problem_in_node(file.settings))
    throw bad_input(path, *problem, "shorten the name or raise max_size_bytes");
}

std::size_t outbound_place(const Entry& entry, const std::vector<std::string>& outbound) {
  const std::string name = entry.key.substr(value_prefix.size());
  const auto at = std::ranges::find(outbound, name);
  if (at != outbound.end()) return static_cast<std::size_t>(at - outbound.begin());
  throw bad_input(
      entry.key + " " + entry.place, "no such outbound variable",
      outbound.empty() ? "the list is empty" : "did you mean " + nearest(name, outbound) + "?");
}

void take_values(NodeFile& file, const std::vector<Entry>& entries) {
  protocol::SharedNode node(file.settings);
  for (const Entry& entry : entries) {
    if (!entry.key.starts_with(value_prefix)) continue;
    const std::size_t variable = outbound_place(entry, file.settings.outbound);
    const auto& value = expect<std::string>(entry, "text", "write the value in quotes");
    if (const auto problem = node.set(variable, value))
      throw bad_input(entry.key + " " + entry.place, *problem,
                      std::string(how_to_spell) + ", and not too much of it");
    file.values.emplace_back(variable, value);
  }
}

}  // namespace

NodeFile parse_node_file(const std::string& text, const std::filesystem::path& path) {
  const std::vector<Entry> entries = read_entries(text, path);
  NodeFile file;
  const auto places = take_keys(file, entries);
  require_both_addresses(places, path.string());
  check_together(file, places, path.string());
  take_values(file, entries);
  return file;
}

protocol::SharedNode make_node(const NodeFile& file) {
  protocol::SharedNodeSettings settings = file.settings;
  settings.byte_time = protocol::bits_per_byte * dsp::period(file.baud);
  protocol::SharedNode node(settings);
  for (const auto& [variable, value] : file.values) (void)node.set(variable, value);
  return node;
}

}  // namespace sim
