#pragma once
// GLib's key files (GLib reference manual, "Key-value file parser"), as sigrok's metadata are:
// groups in brackets, KEY=VALUE with blanks wherever, comments behind #. Of equal keys the last
// counts. Lines that are neither are passed over.
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace sim {

struct KeyGroup {
  std::string name;
  std::map<std::string, std::string, std::less<>> entries;

  /// Empty if it is not there.
  std::string value(std::string_view key) const;
};

/// In the order of the text; what stands in several groups of one name is in the first.
std::vector<KeyGroup> read_key_file(std::string_view text);

}  // namespace sim
