#include "sim/scenario/entries.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <set>
#include <tuple>
#include <utility>

#include "sim/failure.hpp"
#include "sim/scenario/key_depth.hpp"
#include "sim/scenario/source_locations.hpp"
#include "sim/text/letters.hpp"

namespace sim {
namespace {

namespace fs = std::filesystem;

struct Located {
  Entry entry;
  std::tuple<std::size_t, std::size_t> where;  // line, column
  bool may_repeat;
};

std::string place_of(const fs::path& path, std::size_t line) {
  return fmt::format("in {}:{}", path.generic_string(), line);
}

std::string name_of(toml::node_type type) {
  switch (type) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "a list that is not of numbers";
    default:
      return "a date or time";
  }
}

Value list_of_texts(const toml::array& list) {
  std::vector<std::string> texts;
  for (const auto& item : list) {
    if (!item.is_string()) return OtherValue{name_of(toml::node_type::array)};
    texts.push_back(*item.value<std::string>());
  }
  return texts;
}

Value list_of_words(const toml::array& list) {
  WordList all;
  for (const auto& item : list) {
    if (const auto* flag = item.as_boolean())
      all.words.emplace_back(flag->get() ? "true" : "false");
    else if (const auto* text = item.as_string())
      all.words.push_back(text->get());
    else
      return OtherValue{name_of(toml::node_type::array)};
  }
  return all;
}

Value list_of_numbers(const toml::array& list) {
  std::vector<double> values;
  for (const auto& item : list) {
    if (!item.is_number()) return OtherValue{name_of(toml::node_type::array)};
    values.push_back(*item.value<double>());
  }
  return values;
}

Value list_value(const toml::array& list) {
  const auto is_flag = [](const toml::node& item) { return item.is_boolean(); };
  if (std::any_of(list.begin(), list.end(), is_flag)) return list_of_words(list);
  return !list.empty() && list.front().is_string() ? list_of_texts(list) : list_of_numbers(list);
}

Value to_value(const toml::node& node) {
  if (const auto* integer = node.as_integer()) return static_cast<double>(integer->get());
  if (const auto* real = node.as_floating_point()) return real->get();
  if (const auto* flag = node.as_boolean()) return flag->get();
  if (const auto* text = node.as_string()) return text->get();
  if (const auto* list = node.as_array()) return list_value(*list);
  return OtherValue{name_of(node.type())};
}

class Flattener {
 public:
  Flattener(const fs::path& path, const std::vector<std::string>& repeatable)
      : path_(path), repeatable_(repeatable) {}

  void table(const toml::table& table, const std::string& prefix, bool may_repeat) {
    for (const auto& [key, node] : table)
      item(prefix + std::string(key.str()), key.source().begin, node, may_repeat);
  }

  std::vector<Located> take() { return std::move(found_); }

 private:
  void item(const std::string& key, const toml::source_position& at, const toml::node& node,
            bool may_repeat) {
    const bool repeats = std::ranges::find(repeatable_, key) != repeatable_.end();
    if (repeats) require_brackets(key, at, node);
    const auto* inner = node.as_table();
    if (inner && !inner->empty()) return table(*inner, key + ".", may_repeat);
    if (node.is_array_of_tables()) {
      return tables(*node.as_array(), key + ".", may_repeat || repeats);
    }
    found_.push_back(
        {{key, to_value(node), place_of(path_, at.line)}, {at.line, at.column}, may_repeat});
  }

  void tables(const toml::array& list, const std::string& prefix, bool may_repeat) {
    for (const auto& element : list) table(*element.as_table(), prefix, may_repeat);
  }

  /// Behind any other form nobody could write one more.
  void require_brackets(const std::string& key, const toml::source_position& at,
                        const toml::node& node) const {
    if (node.is_array_of_tables() && !node.as_array()->front().as_table()->is_inline()) return;
    throw bad_input(key + " " + place_of(path_, at.line), "not written as a table that may repeat",
                    "write [[" + key + "]]");
  }

  const fs::path& path_;
  const std::vector<std::string>& repeatable_;
  std::vector<Located> found_;
};

void refuse_deep_keys(const std::string& text, const fs::path& path) {
  if (const auto line = line_of_deep_key(text))
    throw bad_input("syntax error " + place_of(path, *line),
                    fmt::format("more than {} dots in a key", most_dots), "shorten the key");
}

toml::table parse_toml(const std::string& text, const fs::path& path) {
  try {
    return toml::parse(text, path.generic_string());
  } catch (const toml::parse_error& error) {
    throw bad_input("syntax error " + place_of(path, error.source().begin.line),
                    std::string(error.description()), "correct this line");
  }
}

void refuse_repetition(const std::vector<Located>& found) {
  std::set<std::string> seen;
  for (const auto& [entry, where, may_repeat] : found)
    if (!may_repeat && !seen.insert(entry.key).second)
      throw bad_input(entry.key + " " + entry.place, "given twice in this file",
                      "remove one of the two");
}

bool is_escaped_in_lines(char c) { return is_control(c) && c != '\n' && c != '\t'; }

/// Text between quotes; characters of `kept` stand as they are.
std::string escaped(const std::string& text, std::string_view kept) {
  std::string out;
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (is_control(c) && kept.find(c) == std::string_view::npos)
      out += fmt::format("\\u{:04X}", static_cast<unsigned char>(c));
    else
      out += c;
  }
  return out;
}

}  // namespace

std::string kind_of(const Value& value) {
  if (std::holds_alternative<double>(value)) return "a number";
  if (std::holds_alternative<bool>(value)) return "true or false";
  if (std::holds_alternative<std::string>(value)) return "text";
  if (std::holds_alternative<std::vector<double>>(value)) return "a list";
  if (std::holds_alternative<std::vector<std::string>>(value)) return "a list of texts";
  if (std::holds_alternative<WordList>(value)) return "a list with true or false in it";
  return std::get<OtherValue>(value).what;
}

std::vector<Entry> read_entries(const std::string& text, const fs::path& path,
                                const std::vector<std::string>& repeatable) {
  refuse_deep_keys(text, path);
  Flattener flattener(path, repeatable);
  flattener.table(parse_toml(text, path), "", false);
  auto found = flattener.take();
  std::ranges::stable_sort(found, {}, &Located::where);
  refuse_repetition(found);
  std::vector<Entry> entries;
  for (auto& located : found) entries.push_back(std::move(located.entry));
  return entries;
}

std::string toml_string(const std::string& text) { return '"' + escaped(text, "") + '"'; }

std::string toml_lines(const std::string& text) {
  const bool as_it_is = text.find("'''") == std::string::npos && !text.ends_with('\'') &&
                        std::ranges::none_of(text, is_escaped_in_lines);
  if (as_it_is) return "'''\n" + text + "'''";
  return "\"\"\"\n" + escaped(text, "\n\t") + "\"\"\"";
}

}  // namespace sim
