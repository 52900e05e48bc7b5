#pragma once
// Entries: the one reader of TOML text, for scenarios and parts alike. A file is a list of keys
// with their values and places; what a key means is for others to say.
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace sim {

/// A TOML value of a kind that no key takes; `what` names it: "a date".
struct OtherValue {
  std::string what;
};

/// A list with true or false in it, as words; it may have texts too.
struct WordList {
  std::vector<std::string> words;
};

using Value = std::variant<double, bool, std::string, std::vector<double>, std::vector<std::string>,
                           WordList, OtherValue>;

/// One `key = value` of a file, with its tables joined to its name by dots.
struct Entry {
  std::string key;
  Value value;
  std::string place;  // "in x.toml:14"
};

/// "a number", "text"...: what a value is, for messages.
std::string kind_of(const Value& value);

/// Entries in the order of the file. No key occurs twice, except in the top tables named in
/// `repeatable`, which are written [[so]] each time.
std::vector<Entry> read_entries(const std::string& text, const std::filesystem::path& path,
                                const std::vector<std::string>& repeatable = {});

/// A text as TOML writes it: in quotes, on one line.
std::string toml_string(const std::string& text);

/// The same with its lines kept as lines.
std::string toml_lines(const std::string& text);

}  // namespace sim
