#pragma once
// A key: what a scenario or a part file may say. The table of all is sim/scenario/keys.
#include <functional>
#include <string>
#include <vector>

#include "sim/scenario/scenario.hpp"

namespace sim {

/// Allowed values of a number; the ends belong to it unless they are open.
struct Range {
  double low = 0, high = 0;
  bool low_open = false;
  bool contains(double value) const {
    return (low_open ? value > low : value >= low) && value <= high;
  }
};
constexpr Range above(double low, double high) { return {low, high, true}; }
constexpr Range from(double low, double high) { return {low, high, false}; }

enum class KeyType {
  number,
  whole_number,
  flag,  // false and true, or a few values with a word each: sim/scenario/flag_words
  text,
  message,
  choice,
  part,
  number_list,  // a text to the program: "1,2,5"; its unit and range are those of each
  messages      // the same, a line each
};

/// What a key is called and what it may hold, whoever owns it.
struct KeyFacts {
  std::string name;       // "receiver.range_m"; in a part file "centre_hz"
  std::string unit;       // "m"; "1" for a plain number; empty for text
  Range range;            // of numbers
  std::string long_name;  // a noun phrase: "distance along the floor"
  std::string note;       // what else a user must know; may be empty
  KeyType type = KeyType::number;
};

/// A key of a scenario. Exactly one of `number` and `text` is set.
struct Key {
  KeyFacts facts;
  std::function<double&(Scenario&)> number;
  std::function<std::string&(Scenario&)> text;
  std::vector<std::string> choices;  // of KeyType::choice; the words of KeyType::flag
  /// Younger than results of its default, which must stay results of equal input: the text that
  /// tells points apart has it only where it is not at that.
  bool younger = false;
  bool swept = true;  // false of a choice that a whole run makes
  /// Part of the text that tells points apart. Not of titles, seeds and how long to count, of what
  /// is behind the light alone, nor of parts' names, whose numbers count.
  bool physics = true;

  const std::string& name() const { return facts.name; }
  bool is_number() const { return static_cast<bool>(number); }
};

}  // namespace sim
