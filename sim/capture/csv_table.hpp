#pragma once
// Rows of numbers out of text, as logic analysers, oscilloscopes and programs write them: columns
// apart by comma, semicolon, tab or blanks, decimals with a point or, where a comma separates
// nothing, with a comma. What is no row is the head (csv_head.hpp), above the rows or beside them.
// What a cell says is told in csv_fields.hpp; a channel that is off says nothing in Saleae's and
// PicoScope's.
#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/capture/csv_head.hpp"
#include "sim/capture/text_lines.hpp"

namespace sim {

class CsvTable {
 public:
  /// Passes `skip` lines over, then reads rows ahead, to see what the columns hold.
  CsvTable(std::istream& in, std::string file, std::size_t skip);

  const std::vector<Heading>& columns() const { return columns_; }
  const CsvHead& head() const { return head_; }
  /// Where they stand in their lines, as the head is asked for them.
  const CsvHead::Columns& place() const { return place_; }

  /// Rows that were read ahead, at least one, until they are given by next().
  std::size_t rows_ahead() const { return ahead_numbers_.size(); }
  double ahead(std::size_t row, std::size_t column) const {
    return ahead_[row * columns_.size() + column];
  }
  std::size_t line_ahead(std::size_t row) const { return ahead_numbers_[row]; }
  /// Whether all rows were.
  bool is_whole() const { return whole_; }

  /// A cell for each column, NaN where it says nothing; nothing at the end. A last line that was
  /// cut short is none.
  std::optional<std::vector<double>> next();

  /// Of the last row given.
  std::size_t line() const { return at_line_; }
  [[noreturn]] void fail(std::string_view problem, std::string_view why) const {
    lines_.fail_at(at_line_, problem, why);
  }
  [[noreturn]] void fail_at(std::size_t line, std::string_view problem, std::string_view why,
                            const std::string& suggestion = "") const {
    lines_.fail_at(line, problem, why, suggestion);
  }

 private:
  struct Line {
    std::size_t number;
    std::string text;
  };
  /// Where rows stand in their lines.
  struct Layout {
    char separator = ',';
    bool decimal_comma = false;
    std::size_t first = 0, count = 0;  // fields
  };

  void read_first_lines(std::size_t skip);
  void find_layout();
  void widen_to_names();
  bool may_separate(char separator, bool comma) const;
  void refuse_clock_times();
  void refuse_words();
  void read_head();
  void read_head_line(const Line& line);
  void read_head_beside();
  void read_ahead();
  void name_columns();
  static bool is_remark_of(std::string_view line, char separator);
  static std::optional<std::string> word_in_row(const std::vector<std::string>& fields, bool comma);
  static std::optional<Layout> layout_of(const std::string& line, char separator, bool comma);
  std::optional<std::vector<double>> row_of(std::string_view line) const;
  std::optional<std::vector<double>> read_row();
  [[noreturn]] void fail_at_second_head(const std::string& line) const;
  std::optional<std::string> next_line();

  TextLines lines_;
  std::deque<Line> first_lines_;
  std::size_t at_line_ = 1;
  bool first_are_all_ = false, cut_ = false, whole_ = false;
  Layout layout_;
  CsvHead head_;
  std::optional<std::pair<std::size_t, std::string>> odd_word_;  // its line
  CsvHead::Columns place_;
  std::vector<Heading> columns_;
  std::vector<double> ahead_;               // row by row
  std::vector<std::size_t> ahead_numbers_;  // of their lines
  std::size_t given_ = 0;                   // of the rows ahead
};

}  // namespace sim
