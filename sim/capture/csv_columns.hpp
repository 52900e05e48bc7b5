#pragma once
// What a column of a table is, by its heading and by its rows ahead: a wire, the time, or numbers
// of the rows.
#include <cstddef>
#include <cstdint>
#include <optional>

#include "sim/capture/csv_table.hpp"

namespace sim {

/// Of 0 and 1 alone, where a cell says anything.
bool is_logic(const CsvTable& table, std::size_t column);

/// The level in a cell of such a column; nothing where the cell says nothing.
std::optional<bool> level_in(double cell);

/// Changes of a column of 0 and 1; nothing of others.
std::optional<std::uint64_t> edges_of(const CsvTable& table, std::size_t column);

bool is_constant(const CsvTable& table, std::size_t column);

/// Never back, and on at last: times may repeat where they are printed with too few digits.
bool rises(const CsvTable& table, std::size_t column);

/// Whether it has the name of a column that numbers the rows: "Index", "Sample #".
bool counts_rows(const Heading& heading);

/// By its name; else the first that rises, but one that counts rows.
std::optional<std::size_t> time_column(const CsvTable& table);

}  // namespace sim
