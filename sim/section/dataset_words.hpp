#pragma once
// What is said of a dataset in words: sentences for the answer on top of a report, each ended by a
// newline, or empty where there is nothing to say.
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/columns/column.hpp"
#include "sim/result/dataset.hpp"
#include "sim/result/place_text.hpp"
#include "sim/result/stored_dataset.hpp"

namespace sim {

/// Points of which something is known: those with runs or trials.
std::vector<std::size_t> measured_points(const Dataset& data);

/// A name of the program as people say it: "poor_fit" is "poor fit".
std::string plain_words(const std::string& name);

/// "8 runs at 3 points", "1 run": all that were done.
std::string runs_text(const Dataset& data);

/// Of a variable that has one cell a point: "Frame loss is 0.12 [0.1, 0.15]." Of a sweep where it
/// is least and where it is greatest; where nothing was found, by the upper end. `unit` stands
/// behind the numbers.
std::string extremes(const Dataset& data, const std::string& name, const std::string& what,
                     const std::string& unit = "");

/// The same of each drawn column that has one cell a point, a line each.
std::string extremes_of(const Dataset& data, const std::vector<ColumnFacts>& columns);

/// How many points were not finished, as they have fewer runs or trials than the scenario asks for.
std::string missing_points(const StoredDataset& stored);

}  // namespace sim
