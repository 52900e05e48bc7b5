#pragma once
// Method: which trials are run and what they count for, by the key simulation.method. A new one is
// a row of the table in method.cpp.
#include <span>
#include <string>

#include "sim/scenario/scenario.hpp"

namespace sim {

enum class Method {
  brute_force,  // trials as they come, each counting once
  importance    // trials whose noise is drawn to make them fail, with weights: for rare errors
};

struct MethodName {
  const char* name;
  Method method;
};

std::span<const MethodName> methods();

Method method_of(const SimulationSettings& simulation);

/// Throws Failure(bad_input) where the scenario has what its method cannot do.
void check_method(const Scenario& scenario, const SourceLocations& places);

/// Throws Failure(bad_input), saying why, where trials have weights.
void refuse_weighted(const Scenario& scenario, const std::string& why);

}  // namespace sim
