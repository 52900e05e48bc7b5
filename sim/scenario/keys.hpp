#pragma once
// Keys: the one table of all that a scenario or a part file may say: name, unit, default, bounds,
// meaning and place in the program. Loading, sweeping, --set, hashing and the README all follow it.
#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "channel/photodiode.hpp"
#include "sim/scenario/key.hpp"

namespace sim {

/// Where a part may lie whose file does not give a number, and why there.
struct UnsaidBounds {
  channel::NumberBounds bounds;
  std::string reason;
};

/// A number in a part's file. `required`: a data sheet prints it, so that no default can be right.
template <class Part>
struct PartNumber {
  KeyFacts facts;
  double Part::*member;
  bool required;
  std::optional<UnsaidBounds> unsaid = {};
};

/// A curve in a part's file: two lists of equal length, x increasing strictly.
template <class Part>
struct PartCurve {
  std::string name, long_name;
  KeyFacts x, y;
  channel::Curve Part::*member;
  bool required;
};

/// One word of a few in a part's file, which says what the part is and so needs no source.
template <class Part>
struct PartChoice {
  KeyFacts facts;
  std::string Part::*member;
  std::vector<std::string> choices;
};

template <class Part>
struct PartKeys {
  std::string kind;    // "module"
  std::string folder;  // "modules"
  std::vector<PartNumber<Part>> numbers;
  std::vector<PartCurve<Part>> curves;
  std::vector<std::pair<std::string, std::string>> either = {};  // exactly one of the two is given
  std::vector<std::string> figures =
      {};  // of sim/scenario/figures.hpp, for which a file may name curves
  std::vector<PartChoice<Part>> choices = {};
  bool (*needs_numbers)(const Part&) = nullptr;  // false: what is required may be missing
  const char* (*flaw)(const Part&) = nullptr;    // what of it cannot be; null: nothing
};

const PartKeys<channel::ModuleData>& module_keys();
const PartKeys<channel::EmitterData>& led_keys();
const PartKeys<channel::Floor>& floor_keys();
const PartKeys<channel::PhotodiodeData>& photodiode_keys();

/// All keys of a scenario, in the order of the README and of the canonical text: those of all
/// experiments, and behind them those of each experiment alone.
const std::deque<Key>& scenario_keys();

/// The key of the part that gives a key its value where the scenario does not, or nothing.
std::string part_giving(const std::string& name);

/// The key of that name, those of named tables included, or nothing. Not for several threads at
/// once: it makes keys of named tables as they are asked for.
const Key* find_key(const std::string& name);

}  // namespace sim
