#pragma once
// The instants of a table's rows: by a column that is the time, in a unit that is told, named, or
// found by the rate in the head; else by that rate. A rate that is told takes the place of a column
// that only rises. A unit that the head names for no column is refused, not lost.
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/capture/capture_file.hpp"
#include "sim/capture/csv_table.hpp"

namespace sim {

class RowClock {
 public:
  /// Says in `facts` what it found and what it assumed. Throws Failure(bad_input).
  RowClock(const CsvTable& table, const CaptureSettings& settings, CaptureFacts& facts);

  bool has_column() const { return column_.has_value(); }
  std::optional<std::size_t> column() const { return column_; }
  std::optional<dsp::Hertz> rate() const { return rate_; }
  /// From row to row; 0 where they have times of their own.
  dsp::Seconds resolution() const {
    return column_ || !rate_ ? dsp::Seconds(0) : dsp::period(*rate_);
  }

  /// Of the next row, which stands in that line.
  dsp::Seconds next(const CsvTable& table, const std::vector<double>& row, std::size_t line);

  dsp::Seconds now() const { return now_; }

 private:
  void find_unit(const CsvTable& table, const CaptureSettings& settings, CaptureFacts& facts);

  std::optional<dsp::Hertz> rate_;
  std::optional<std::size_t> column_;
  double unit_ = 1, origin_ = 0;
  std::uint64_t count_ = 0;
  dsp::Seconds now_;
};

}  // namespace sim
