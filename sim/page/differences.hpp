#pragma once
// In what the results of a page differ: keys of their scenarios.
#include <string>
#include <vector>

#include "sim/page/page.hpp"
#include "sim/scenario/settings.hpp"

namespace sim {

struct NamedSettings {
  std::string name;  // of a result
  std::vector<Setting> settings;
};

/// A row for each key that not all set alike, "-" where a scenario has no such key or leaves it
/// empty; a column for each result.
PageSection differences_section(const std::vector<NamedSettings>& results);

}  // namespace sim
