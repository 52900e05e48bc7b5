#pragma once
// Part slots: what of a scenario a part fills, for each key that names a part.
#include <string>

#include "sim/scenario/scenario.hpp"

namespace sim {

struct PartSlot {
  std::string ending;                                // of its keys: "receiver.module"
  std::string folder;                                // "modules"
  std::string (*name)(const Scenario&);              // of the part that is in it
  void (*copy)(const Scenario& from, Scenario& to);  // the part and nothing else
  bool (*to_be_had)(const Scenario&);                // false for a part that exists in theory only
};

/// The slot of a key of KeyType::part.
const PartSlot& part_slot(const std::string& key);

}  // namespace sim
