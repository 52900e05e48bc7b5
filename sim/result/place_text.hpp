#pragma once
// Places of a sweep in words.
#include <cstddef>
#include <string>
#include <vector>

#include "sim/result/dataset.hpp"
#include "sim/scenario/axis.hpp"

namespace sim {

/// "receiver.range_m = 7 m": a value of an axis with its unit, if it has one.
std::string quantity(const Axis& axis, const std::string& value);

/// "receiver.range_m = 2.2 m, receiver.module = TSOP4856": a point of a sweep; empty where nothing
/// was swept.
std::string place_text(const std::vector<Axis>& axes, const std::vector<double>& coordinates);

/// Of a point of a result.
std::string place_text(const Dataset& data, std::size_t point);

/// "one, other": both, or the one that is not empty.
std::string joined(const std::string& one, const std::string& other);

/// "sender A", "false_alarm = 0.01": the elements that a variable has at each point, in their
/// order; one empty text where it has no dimensions.
std::vector<std::string> element_texts(const Dataset& data, const Dataset::Variable& variable);

}  // namespace sim
