#pragma once
// Where the models end: each has a range in which a data sheet or a formula stands behind it
// (channel/README.md). A point outside of one is computed all the same, and flagged.
#include <cstdint>
#include <span>

#include "sim/link/operating_point.hpp"
#include "sim/scenario/scenario.hpp"

namespace sim {

/// One way to leave a model's range: bit i of a point's mask is row i of the table.
struct ValidityLimit {
  const char* name;     // "near", as the table and the result file call it
  const char* meaning;  // one line: what is not known there
  bool (*left)(const Scenario& scenario, const OperatingPoint& at);
};

std::span<const ValidityLimit> validity_limits();

/// Marks them in tables.
constexpr const char* validity_sign = "!";

/// The limits that a point leaves.
std::uint64_t validity_flags_of(const Scenario& scenario, const OperatingPoint& at);

}  // namespace sim
