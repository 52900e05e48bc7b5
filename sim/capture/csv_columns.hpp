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

/// Whether it rises and is named a time or a number of the row ("Index", "Sample #"), or counts
/// rows one by one.
bool is_no_line(const CsvTable& table, std::size_t column);

/// By its name or its unit, and of several the finest; else the first that rises and does not count
/// rows. Throws bad_input where several tell other times.
std::optional<std::size_t> time_column(const CsvTable& table);

/// Whether more than one cell in twenty is beyond what the instrument could show.
bool is_beyond_range(const CsvTable& table, std::size_t column);

}  // namespace sim
