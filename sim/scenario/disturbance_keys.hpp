#pragma once
// Keys of other lights: [disturbance.NAME], NAME being the user's own. What such a table may say
// depends on its kind, and so do the defaults.
#include <string>
#include <vector>

#include "dsp/units.hpp"
#include "sim/scenario/key.hpp"

namespace sim {

/// A number of a kind, and its default there.
struct DisturbanceNumber {
  KeyFacts facts;  // named by the last part of the key: "ballast_hz"
  double DisturbanceSettings::*member;
  double standard;
};

/// How a light moves in time.
enum class LightWave { steady, ripple, fluorescent, pulses, keyed };

struct DisturbanceKind {
  std::string name;                        // "fluorescent"
  std::string long_name;                   // "fluorescent lamp at an electronic ballast"
  std::vector<DisturbanceNumber> numbers;  // the first says how bright it is
  LightWave wave = LightWave::keyed;
  bool has_message = false;
  /// As if at 950 nm, of a lamp that is rated in lux.
  dsp::WattsPerSquareMetre (*light_of_lux)(double lux) = nullptr;
};

const std::vector<DisturbanceKind>& disturbance_kinds();

/// The key "disturbance.NAME.WHAT" that some kind has; nothing if there is none. Not for several
/// threads at once.
const Key* find_disturbance_key(const std::string& name);

/// Keys that a table [disturbance.NAME] may have, of all kinds.
std::vector<std::string> disturbance_key_names(const std::string& name);

/// NAME of "disturbance.NAME.WHAT", whatever it holds; empty if the key is no such thing.
std::string disturbance_of(const std::string& key);

/// Sets all numbers to what they are for its kind unless it says otherwise.
void take_defaults(DisturbanceSettings& disturbance);

/// The kind of one that has been loaded.
const DisturbanceKind& kind_of(const DisturbanceSettings& disturbance);

/// Throw unless every disturbance has a kind, and every key in `places` belongs to the kind of its
/// own.
void check_kinds(const Scenario& scenario, const SourceLocations& places);

}  // namespace sim
