#pragma once
// The instants of a table's rows: by a column that is the time, in a unit that is told, named, or
// found by the rate in the head; else by that rate.
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
