#pragma once
// Tables of flags: row i, with its `name` and its `meaning`, is bit i of a point's mask.
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace sim {

/// The rows of the bits that are set.
template <class Flag>
std::vector<const Flag*> raised(std::span<const Flag> table, std::uint64_t mask) {
  std::vector<const Flag*> rows;
  for (std::size_t i = 0; i < table.size(); ++i)
    if ((mask >> i & 1U) != 0) rows.push_back(&table[i]);
  return rows;
}

/// Their names, joined by commas: "near,emax"; empty if none.
template <class Flag>
std::string raised_names(std::span<const Flag> table, std::uint64_t mask) {
  std::string names;
  for (const Flag* flag : raised(table, mask))
    names += (names.empty() ? "" : ",") + std::string(flag->name);
  return names;
}

/// All names, that of bit i at i.
template <class Flag>
std::vector<std::string> flag_names(std::span<const Flag> table) {
  std::vector<std::string> names;
  for (const Flag& flag : table) names.push_back(flag.name);
  return names;
}

/// "! near,emax"; empty if none.
template <class Flag>
std::string raised_mark(std::span<const Flag> table, std::uint64_t mask, const char* sign) {
  return mask == 0 ? "" : std::string(sign) + " " + raised_names(table, mask);
}

/// A line for each: what a mark such as "! near" means.
template <class Flag>
std::string raised_notes(std::span<const Flag> table, std::uint64_t mask, const char* sign) {
  std::string notes;
  for (const Flag* flag : raised(table, mask))
    notes += std::string(sign) + " " + flag->name + ": " + flag->meaning + "\n";
  return notes;
}

}  // namespace sim
