#pragma once
// A table of a dataset's variables for a report.
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/columns/column.hpp"
#include "sim/result/dataset.hpp"
#include "sim/section/page_section.hpp"

namespace sim {

struct DatasetColumn {
  std::string name;  // of the variable
  std::string head;  // with its unit
  /// What stands in its cell of that number, if it is not the number.
  std::function<std::string(std::size_t cell)> words = {};
};

/// The variable of a column, headed with its unit, "hours of line [h]", and written as in `run`.
DatasetColumn headed_column(const Dataset& data, const ColumnFacts& column);

/// Variables by their names, headed and written as their columns are. A sum that is no
/// column, total_n_known, is headed as that of which it is, and another count by its name.
std::vector<DatasetColumn> headed_columns(const Dataset& data,
                                          const std::vector<ColumnFacts>& columns,
                                          const std::vector<std::string>& names);

/// A row for each point and for each element of the dimensions that the first column's variable
/// has; the others are on the same. Rows of which nothing is known are left out, and columns that
/// the dataset does not have. Nothing where it has none of them.
std::optional<PageTable> dataset_table(const Dataset& data, std::vector<DatasetColumn> columns);

}  // namespace sim
