#pragma once
// Settings: what each key of a scenario holds, as text, to say in what scenarios differ.
#include <string>
#include <vector>

#include "sim/scenario/scenario.hpp"

namespace sim {

struct Setting {
  std::string key, value;  // with its unit: "3 m"; of texts as they are
};

/// Of all keys, those of disturbances and placed devices too; of a swept one its values. Parts are
/// named here, not what their files hold: "by receiver.module".
std::vector<Setting> settings_of(const LoadedScenario& scenario);

}  // namespace sim
