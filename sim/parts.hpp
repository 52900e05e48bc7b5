#pragma once
// Parts: receiver modules and LEDs, one TOML file each in ROOT/modules/ or ROOT/leds/, in which
// every number carries its source. Also the one reader of TOML text, which scenarios share.
#include <cstddef>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "channel/emitter.hpp"
#include "channel/receiver_module.hpp"

namespace sim {

/// A TOML value of a kind that no key takes; `what` names it: "a date".
struct OtherValue {
  std::string what;
};

using Value = std::variant<double, std::string, std::vector<double>, OtherValue>;

/// One `key = value` of a file, with its tables joined to its name by dots.
struct Entry {
  std::string key;
  Value value;
  std::string place;  // "in x.toml:14"
};

/// "a number", "text"...: what a value is, for messages.
std::string kind_of(const Value& value);

/// The text of a file; `what` says what it should be: "scenario".
std::string read_text_file(const std::filesystem::path& path, const std::string& what);

/// Entries in the order of the file. No key occurs twice, except inside arrays of tables.
std::vector<Entry> read_entries(const std::string& text, const std::filesystem::path& path);

/// Folders that hold modules/ and leds/; the first that has a part wins.
using PartRoots = std::vector<std::filesystem::path>;

/// A part by its name (case aside). `asked` opens the error line if there is no such part.
channel::ModuleData load_module(const std::string& name, const PartRoots& roots,
                                const std::string& asked);
channel::EmitterData load_led(const std::string& name, const PartRoots& roots,
                              const std::string& asked);

struct PartFile {
  std::string kind;  // "module" or "LED"
  std::string name;  // the file's, without ".toml"
  std::filesystem::path path;
};

/// All parts to be had, by kind and name; one that an earlier root hides is left out.
std::vector<PartFile> list_parts(const PartRoots& roots);

}  // namespace sim
