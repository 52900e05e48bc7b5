#pragma once
// Rows of numbers out of text, as logic analysers, oscilloscopes and programs write them: columns
// apart by comma, semicolon, tab or blanks, whatever lines stand before the first row of numbers.
// The last of those with as many fields names the columns. Rigol's oscilloscopes end a line with a
// comma and say behind the names how rows lie in time: "X,CH1,Start,Increment," and a line of the
// two numbers, rows then being counted, or "Time(s),CH1(V),t0 = ..., tInc = ...,".
#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "sim/capture/text_lines.hpp"

namespace sim {

class CsvTable {
 public:
  /// Reads up to `rows_ahead` rows, to see what the columns hold.
  CsvTable(std::istream& in, std::string file);

  const std::vector<std::string>& columns() const { return columns_; }
  /// Of sigrok's header.
  std::optional<dsp::Hertz> sample_rate() const { return sample_rate_; }
  const std::deque<std::vector<double>>& ahead() const { return ahead_; }

  /// As many finite numbers as there are columns; nothing at the end. A last line that was cut
  /// short is none.
  std::optional<std::vector<double>> next();

  [[noreturn]] void fail(std::string_view problem, std::string_view why) const {
    lines_.fail(problem, why);
  }

 private:
  static constexpr std::size_t rows_ahead = 1000;

  void read_head();
  void read_head_line(std::string_view line);
  void read_names(std::string_view line);
  void read_grid(const std::vector<std::string_view>& fields);
  void name_columns(std::size_t count);
  std::vector<std::string_view> split(std::string_view line) const;
  std::optional<std::vector<double>> numbers(std::string_view line) const;
  std::optional<std::vector<double>> read_row();

  TextLines lines_;
  char separator_ = ',';
  std::vector<std::string> columns_;   // while the head is read: its last line's fields
  std::vector<std::string> channels_;  // of sigrok's header
  std::optional<dsp::Hertz> sample_rate_;
  struct Grid {
    double start, increment;
  };
  std::size_t grid_field_ = 0;  // of the start in the line behind the names; 0: none
  std::optional<Grid> grid_;    // rows are counted, and lie on it
  std::deque<std::vector<double>> ahead_;
};

}  // namespace sim
