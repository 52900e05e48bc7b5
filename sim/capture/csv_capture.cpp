#include "sim/capture/csv_capture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "sim/capture/csv_table.hpp"
#include "sim/failure.hpp"

namespace sim {
namespace {

using dsp::Hertz;
using dsp::Seconds;
using Row = std::vector<double>;

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  });
  return text;
}

/// Seconds in a time column's unit: "Time [ms]", "time_us".
double unit_of(const std::string& column) {
  static const std::map<std::string, double> units = {{"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}};
  for (const auto& [unit, seconds] : units)
    for (const std::string& written : {"[" + unit + "]", "(" + unit + ")", "_" + unit})
      if (lower(column).ends_with(written)) return seconds;
  return 1;
}

bool is_logic(const CsvTable& table, std::size_t column) {
  return std::ranges::all_of(table.ahead(),
                             [&](const Row& row) { return row[column] == 0 || row[column] == 1; });
}

bool rises(const CsvTable& table, std::size_t column) {
  const auto back = [&](const Row& a, const Row& b) { return b[column] <= a[column]; };
  return table.ahead().size() > 1 &&
         std::ranges::adjacent_find(table.ahead(), back) == table.ahead().end();
}

/// The instants of rows.
class RowClock {
 public:
  RowClock(const CsvTable& table, std::optional<Hertz> told) : rate_(told) {
    const std::string first = lower(table.columns().front());
    const bool named =
        first.starts_with("time") || first == "t" || first == "x" || first == "second";
    const bool nameless = first == "0" && table.columns().size() > 1 && !is_logic(table, 0);
    has_column_ = (named || nameless) && rises(table, 0);
    unit_ = unit_of(first);
    const double start = table.ahead().front().front() * unit_;
    if (has_column_ && start < 0) origin_ = start;
    if (!rate_) rate_ = table.sample_rate();
  }

  bool has_column() const { return has_column_; }
  std::optional<Hertz> rate() const { return rate_; }

  /// Of the next row.
  Seconds next(const CsvTable& table, const Row& row) {
    const double index = static_cast<double>(count_++);
    const Seconds at(has_column_ ? row.front() * unit_ - origin_ : index / rate_->value);
    if (at < now_) table.fail("a row's time", "it is before that of the row before");
    if (at > longest_capture) table.fail("a row's time", "it is after more than 30 years");
    return now_ = at;
  }

  Seconds now() const { return now_; }

 private:
  bool has_column_ = false;
  double unit_ = 1, origin_ = 0;
  std::optional<Hertz> rate_;
  std::uint64_t count_ = 0;
  Seconds now_;
};

class CsvLogic : public LogicCapture {
 public:
  CsvLogic(CsvTable table, RowClock clock, std::vector<std::size_t> columns,
           const std::string& wanted, const std::string& file)
      : table_(std::move(table)), clock_(clock), columns_(std::move(columns)) {
    for (const std::size_t column : columns_) wires_.push_back(table_.columns()[column]);
    wanted_ = wanted_wire(wires_, wanted, file);
    levels_.resize(wires_.size());
    next_ = wires_.size();
  }

  const std::vector<std::string>& wires() const override { return wires_; }
  Seconds now() const override { return clock_.now(); }

  std::optional<WireLevel> next() override {
    for (;;) {
      if (next_ == wires_.size() && !read_row()) return std::nullopt;
      const std::size_t wire = next_++;
      const auto level = level_of(wire);
      if (!level || levels_[wire] == level) continue;
      const bool initial = !levels_[wire].has_value();
      levels_[wire] = level;
      return WireLevel{wire, clock_.now(), *level, initial};
    }
  }

 private:
  bool read_row() {
    auto row = table_.next();
    if (!row) return false;
    row_ = std::move(*row);
    clock_.next(table_, row_);
    next_ = 0;
    return true;
  }

  /// Nothing of an analogue column that began with zeros, unless it is the one that is wanted.
  std::optional<bool> level_of(std::size_t wire) const {
    const double value = row_[columns_[wire]];
    if (value == 0 || value == 1) return value == 1;
    if (wire == wanted_)
      table_.fail(fmt::format("the value {}", value), "the wire was 0 or 1 so far");
    return std::nullopt;
  }

  CsvTable table_;
  RowClock clock_;
  std::vector<std::size_t> columns_;
  std::vector<std::string> wires_;
  std::vector<std::optional<bool>> levels_;
  Row row_;
  std::size_t wanted_ = 0;
  std::size_t next_ = 0;  // wire of the row that was not looked at
};

/// The rate of a time column by the rows at hand.
std::optional<Hertz> measured_rate(const CsvTable& table, RowClock clock) {
  if (!clock.has_column()) return std::nullopt;
  const Seconds first = clock.next(table, table.ahead().front());
  const Seconds span = clock.next(table, table.ahead().back()) - first;
  return Hertz(static_cast<double>(table.ahead().size() - 1) / span.value);
}

class CsvSamples : public SampleCapture {
 public:
  CsvSamples(CsvTable table, RowClock clock, Hertz rate, std::size_t column)
      : table_(std::move(table)), clock_(clock), rate_(rate), column_(column) {}

  Hertz sample_rate() const override { return rate_; }
  bool is_complex() const override { return false; }

  std::size_t read(std::span<std::complex<float>> to) override {
    std::size_t count = 0;
    for (; count < to.size(); ++count) {
      const auto row = table_.next();
      if (!row) break;
      check_spacing(clock_.next(table_, *row));
      to[count] = static_cast<float>((*row)[column_]);
    }
    return count;
  }

 private:
  /// Within two samples and a hundredth of the way: columns are rounded, and so is the rate.
  void check_spacing(Seconds at) {
    if (!first_) first_ = at;
    const double wanted = static_cast<double>(count_++) / rate_.value, is = (at - *first_).value;
    if (std::abs(is - wanted) > 2 / rate_.value + 0.01 * wanted)
      table_.fail("a row's time", "the rows of an analogue column must be evenly spaced");
  }

  CsvTable table_;
  RowClock clock_;
  Hertz rate_;
  std::size_t column_;
  std::uint64_t count_ = 0;
  std::optional<Seconds> first_;
};

struct Columns {
  std::vector<std::size_t> logic, analogue;
};

Columns columns_of(const CsvTable& table, const RowClock& clock) {
  Columns columns;
  for (std::size_t i = clock.has_column() ? 1 : 0; i < table.columns().size(); ++i)
    (is_logic(table, i) ? columns.logic : columns.analogue).push_back(i);
  return columns;
}

/// The analogue column that is wanted, if it is one.
std::optional<std::size_t> wanted_column(const CsvTable& table, const Columns& columns,
                                         const std::string& wanted) {
  for (const std::size_t column : columns.analogue)
    if (table.columns()[column] == wanted || (wanted.empty() && columns.logic.empty()))
      return column;
  return std::nullopt;
}

}  // namespace

void open_csv(const std::string& file, const CaptureSettings& settings, Capture& capture) {
  CsvTable table(*capture.in, file);
  const RowClock clock(table, settings.sample_rate);
  const Columns columns = columns_of(table, clock);
  const auto analogue = wanted_column(table, columns, settings.wire);
  const auto rate = clock.rate() ? clock.rate() : measured_rate(table, clock);
  if (!clock.has_column() && !rate)
    throw bad_input(file + " has no sample rate", "it has no column time either",
                    "say --sample-rate");
  if (analogue && !is_sample_rate(*rate))
    table.fail("the rows' times", "an analogue column has 1 to 1e12 rows a second");
  if (!analogue) {
    capture.logic =
        std::make_unique<CsvLogic>(std::move(table), clock, columns.logic, settings.wire, file);
  } else {
    capture.samples = std::make_unique<CsvSamples>(std::move(table), clock, *rate, *analogue);
  }
}

}  // namespace sim
