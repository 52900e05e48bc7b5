#pragma once
// What columns are called in the tables of a page.
#include <string>
#include <string_view>

#include "sim/columns/column.hpp"

namespace sim {

/// With its unit: "hours of line [h]".
std::string page_heading(const ColumnFacts& column);

/// "in reach" of total_n_in_reach
std::string name_in_words(std::string_view name);

/// Of a sum, total_n_in_reach, the name of that of which it is; another name as it is.
std::string_view name_of_each(std::string_view name);

}  // namespace sim
