#pragma once
// ParsedScenario: what a scenario's file and the command line say, checked key by key, before any
// part is looked up: which parts those are depends on the last word of both.
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "sim/components/parts.hpp"
#include "sim/scenario/axis.hpp"
#include "sim/scenario/entries.hpp"
#include "sim/scenario/keys.hpp"
#include "sim/scenario/scenario.hpp"

namespace sim {

struct ParsedScenario {
  std::map<const Key*, double> numbers;
  std::map<const Key*, std::string> texts;
  std::vector<Axis> sweep;         // in the order of the file, then of --set
  std::vector<CarriedPart> parts;  // of the file's [[part]] tables
  SourceLocations places;

  /// Throws bad_input out of the key's bounds.
  void set_number(const Key& key, double value, const std::string& place);
  void set_text(const Key& key, const std::string& value, const std::string& place);
  /// The last axis of a key counts.
  void set_axis(Axis axis, const std::string& place);
  void drop_axis(const Key& key);
};

/// How much of each point shall be simulated, as an override that names no key: "-n=500".
inline constexpr std::string_view amount_option = "-n=";

/// Units in place of the parts, as an override that names no key.
inline constexpr std::string_view doubt_option = "--doubt";
/// The key and the units that it stands for. It comes last, wherever it is given.
inline constexpr std::string_view doubt_override = "receiver.unit=1:1:32";

/// The overrides with the key of the scenario's experiment in place of amount_option:
/// "stop.max_frames=500" of a link, "arena.runs=500" of an arena. These are the last.
std::vector<std::string> with_amount_key(const std::vector<Entry>& entries,
                                         const std::vector<std::string>& overrides);

/// Entries of the file in their order, then the file's own overrides, then those of --set, then the
/// units of --doubt. Throws bad_input, naming place and remedy, of the first that cannot be.
ParsedScenario parsed_scenario_of(const std::vector<Entry>& entries,
                                  const std::vector<std::string>& overrides);

}  // namespace sim
