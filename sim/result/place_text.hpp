#pragma once
// Places of a sweep in words.
#include <string>
#include <vector>

#include "sim/result/result.hpp"

namespace sim {

/// "receiver.range_m = 7 m": a value of an axis with its unit, if it has one.
std::string quantity(const Axis& axis, const std::string& value);

/// "receiver.range_m = 2.2 m, receiver.module = TSOP4856": a point of a sweep; empty where nothing
/// was swept.
std::string place_text(const std::vector<Axis>& axes, const std::vector<double>& coordinates);

}  // namespace sim
