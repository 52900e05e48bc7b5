#pragma once
// A table of a dataset's variables for a report.
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/result/dataset.hpp"
#include "sim/section/page_section.hpp"

namespace sim {

struct DatasetColumn {
  std::string name;  // of the variable
  std::string head;  // with its unit
  /// What stands in its cell of that number, if it is not the number.
  std::function<std::string(std::size_t cell)> words = {};
};

/// A row for each point and for each element of the dimensions that the first column's variable
/// has; the others are on the same. Rows of which nothing is known are left out, and columns that
/// the dataset does not have. Nothing where it has none of them.
std::optional<PageTable> dataset_table(const Dataset& data, std::vector<DatasetColumn> columns);

}  // namespace sim
