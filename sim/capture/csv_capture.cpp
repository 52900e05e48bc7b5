#include "sim/capture/csv_capture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

#include "sim/capture/carrier_demodulator.hpp"
#include "sim/capture/csv_clock.hpp"
#include "sim/capture/csv_columns.hpp"
#include "sim/capture/csv_table.hpp"
#include "sim/capture/sample_choice.hpp"
#include "sim/capture/wire_choice.hpp"
#include "sim/failure.hpp"
#include "sim/text/escaped_text.hpp"

namespace sim {
namespace {

using dsp::Hertz;
using dsp::Seconds;
using Row = std::vector<double>;

constexpr double longest_step = 10;  // of rows, in usual ones

std::string name_of(const CsvTable& table, std::size_t column) {
  const Heading& heading = table.columns()[column];
  return heading.text.empty() ? std::to_string(column) : heading.text;
}

class CsvLogic : public LogicCapture {
 public:
  CsvLogic(CsvTable table, RowClock clock, std::vector<std::size_t> columns)
      : table_(std::move(table)), clock_(clock), columns_(std::move(columns)) {
    for (const std::size_t column : columns_) wires_.push_back(name_of(table_, column));
    levels_.resize(wires_.size());
    next_ = wires_.size();
  }

  const std::vector<std::string>& wires() const override { return wires_; }
  Seconds now() const override { return clock_.now(); }
  Seconds resolution() const override { return clock_.resolution(); }

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
    clock_.next(table_, row_, table_.line());
    next_ = 0;
    return true;
  }

  std::optional<bool> level_of(std::size_t wire) const {
    const double value = row_[columns_[wire]];
    if (!std::isnan(value) && value != 0 && value != 1)
      table_.fail(fmt::format("the value {}", value),
                  "column " + wires_[wire] + " was 0 or 1 so far");
    return level_in(value);
  }

  CsvTable table_;
  RowClock clock_;
  std::vector<std::size_t> columns_;
  std::vector<std::string> wires_;
  std::vector<std::optional<bool>> levels_;
  Row row_;
  std::size_t next_ = 0;  // wire of the row that was not looked at
};

/// How rows go on in time.
struct Pace {
  Hertz rate;
  Seconds step;  // the usual one, where times repeat because they are printed with few digits
};

/// By a time column, of the rows at hand; steps much longer than the usual one are gaps.
std::optional<Pace> measured_pace(const CsvTable& table, RowClock clock) {
  if (!clock.has_column() || table.rows_ahead() < 2) return std::nullopt;
  std::vector<double> steps;
  std::optional<Seconds> last;
  Row cells(table.columns().size());
  for (std::size_t row = 0; row < table.rows_ahead(); ++row) {
    cells[*clock.column()] = table.ahead(row, *clock.column());
    const Seconds at = clock.next(table, cells, table.line_ahead(row));
    if (last) steps.push_back((at - *last).value);
    last = at;
  }
  std::vector<double> sorted = steps;
  std::erase(sorted, 0.0);
  if (sorted.empty()) return std::nullopt;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::ranges::nth_element(sorted, middle);
  const double usual = *middle;
  std::erase_if(steps, [&](double step) { return step > longest_step * usual; });
  const double time = std::accumulate(steps.begin(), steps.end(), 0.0);
  return Pace{Hertz(static_cast<double>(steps.size()) / time), Seconds(usual)};
}

/// What a column says, cell by cell: as before where a cell says nothing, at first what it says
/// first. A cell beyond the instrument's range is a little beyond all others.
class Held {
 public:
  Held(const CsvTable& table, std::size_t column) {
    for (std::size_t row = 0; row < table.rows_ahead(); ++row) {
      const double cell = table.ahead(row, column);
      if (!std::isfinite(cell)) continue;
      if (lowest_ > highest_) last_ = static_cast<float>(cell);
      lowest_ = std::min(lowest_, cell);
      highest_ = std::max(highest_, cell);
    }
    if (lowest_ > highest_) lowest_ = highest_ = 0;
    more_ = highest_ > lowest_ ? (highest_ - lowest_) / 4 : 1;
  }

  float operator()(double cell) {
    if (std::isinf(cell)) cell = cell > 0 ? highest_ + more_ : lowest_ - more_;
    if (!std::isnan(cell)) last_ = static_cast<float>(cell);
    return last_;
  }

 private:
  float last_ = 0;
  double lowest_ = std::numeric_limits<double>::infinity(), highest_ = -lowest_;
  double more_ = 0;
};

class CsvSamples : public SampleCapture {
 public:
  CsvSamples(CsvTable table, RowClock clock, const Pace& pace, std::size_t column)
      : held_(table, column),
        table_(std::move(table)),
        clock_(clock),
        pace_(pace),
        column_(column) {}

  Hertz sample_rate() const override { return pace_.rate; }
  bool is_complex() const override { return false; }

  std::size_t read(std::span<std::complex<float>> to) override {
    std::size_t count = 0;
    for (; count < to.size(); ++count) {
      const auto row = table_.next();
      if (!row) break;
      check_spacing(clock_.next(table_, *row, table_.line()));
      to[count] = held_((*row)[column_]);
    }
    return count;
  }

 private:
  /// Within two samples and a hundredth of the way: columns are rounded, and so is the rate.
  void check_spacing(Seconds at) {
    if (!first_) first_ = last_ = at;
    if (at - last_ > longest_step * pace_.step)
      table_.fail("a row's time",
                  "rows of an analogue column are missing before it, or are not evenly spaced");
    last_ = at;
    const Seconds sample = dsp::period(pace_.rate);
    const double wanted = static_cast<double>(count_++) * sample.value, is = (at - *first_).value;
    if (std::abs(is - wanted) > 2 * std::max(sample, pace_.step).value + 0.01 * wanted)
      table_.fail("a row's time", "the rows of an analogue column must be evenly spaced");
  }

  Held held_;
  CsvTable table_;
  RowClock clock_;
  Pace pace_;
  std::size_t column_;
  std::uint64_t count_ = 0;
  std::optional<Seconds> first_;
  Seconds last_;
};

/// A column of the rows at hand, as samples.
class SamplesAhead : public SampleCapture {
 public:
  SamplesAhead(const CsvTable& table, Hertz rate, std::size_t column)
      : table_(table), held_(table, column), rate_(rate), column_(column) {}

  Hertz sample_rate() const override { return rate_; }
  bool is_complex() const override { return false; }

  std::size_t read(std::span<std::complex<float>> to) override {
    std::size_t count = 0;
    for (; count < to.size() && next_ < table_.rows_ahead(); ++count, ++next_)
      to[count] = held_(table_.ahead(next_, column_));
    return count;
  }

 private:
  const CsvTable& table_;
  Held held_;
  Hertz rate_;
  std::size_t column_, next_ = 0;
};

/// A column of 0 and 1 of the rows at hand, as a wire.
class LevelsAhead : public LogicCapture {
 public:
  LevelsAhead(const CsvTable& table, const RowClock& clock, std::size_t column)
      : table_(table), clock_(clock), column_(column), row_(table.columns().size()) {}

  const std::vector<std::string>& wires() const override { return wires_; }
  Seconds now() const override { return clock_.now(); }
  Seconds resolution() const override { return clock_.resolution(); }

  std::optional<WireLevel> next() override {
    while (next_ < table_.rows_ahead()) {
      if (clock_.has_column()) row_[*clock_.column()] = table_.ahead(next_, *clock_.column());
      const Seconds at = clock_.next(table_, row_, table_.line_ahead(next_));
      const auto level = level_in(table_.ahead(next_++, column_));
      if (!level || level == level_) continue;
      const bool initial = !level_.has_value();
      level_ = level;
      return WireLevel{0, at, *level, initial};
    }
    return std::nullopt;
  }

 private:
  std::vector<std::string> wires_{"column"};
  const CsvTable& table_;
  RowClock clock_;
  std::size_t column_, next_ = 0;
  Row row_;
  std::optional<bool> level_;
};

/// Columns that may be a line: all but the time and those that number the rows, in their order.
struct Channels {
  std::vector<std::size_t> columns;
  std::vector<std::string> names;
};

Channels channels_of(const CsvTable& table, const RowClock& clock) {
  Channels channels;
  for (std::size_t i = 0; i < table.columns().size(); ++i) {
    if (i == clock.column() || is_no_line(table, i)) continue;
    channels.columns.push_back(i);
    channels.names.push_back(name_of(table, i));
  }
  if (channels.columns.empty()) table.fail("no column of levels", "there is nothing to decode");
  return channels;
}

/// Of rows, where columns may be read as samples. The head's rate may be that of the instrument, of
/// which the file has fewer rows.
std::optional<Pace> pace_of_samples(const CsvTable& table, const RowClock& clock) {
  constexpr double rounding = 0.02;
  auto pace = measured_pace(table, clock);
  const auto rate = clock.rate();
  if (rate && !clock.has_column()) pace = Pace{*rate, dsp::period(*rate)};
  if (rate && pace && std::abs(*rate / pace->rate - 1) < rounding) pace->rate = *rate;
  return pace && is_sample_rate(pace->rate) ? pace : std::nullopt;
}

ChannelSurvey survey_of_column(const CsvTable& table, const RowClock& clock, std::size_t column,
                               const std::string& name, const LineHints& hints) {
  const bool moves = !is_constant(table, column);
  if (moves && is_logic(table, column)) {
    LevelsAhead levels(table, clock, column);
    WireEdges edges(levels, 0);
    CarrierDemodulator line(edges, hints.carrier);
    return survey_of(name, line, hints);
  }
  const auto pace = moves ? pace_of_samples(table, clock) : std::nullopt;
  if (!pace || is_beyond_range(table, column)) return {.name = name};
  SamplesAhead samples(table, pace->rate, column);
  return survey_of_samples(name, samples, hints);
}

std::vector<ChannelSurvey> surveys_of_columns(const CsvTable& table, const RowClock& clock,
                                              const Channels& channels, const LineHints& hints) {
  std::vector<ChannelSurvey> surveys;
  for (std::size_t i = 0; i < channels.columns.size(); ++i)
    surveys.push_back(
        survey_of_column(table, clock, channels.columns[i], channels.names[i], hints));
  return surveys;
}

/// The place among the channels of the one that is read.
std::size_t chosen(const CsvTable& table, const RowClock& clock, const Channels& channels,
                   const std::string& file, const CaptureSettings& settings, CaptureFacts& facts) {
  if (!settings.wire.empty()) {
    for (std::size_t i = 0; i < channels.names.size(); ++i)
      facts.channels.push_back({channels.names[i], edges_of(table, channels.columns[i])});
    const auto has_bare_name = [&](const std::string& name) {  // "CH1" of "CH1 (V)"
      return heading_of(name).name == settings.wire;
    };
    const bool is_exact = std::ranges::find(channels.names, settings.wire) != channels.names.end();
    const auto bare = std::ranges::find_if(channels.names, has_bare_name);
    return is_exact || bare == channels.names.end()
               ? named_channel(channels.names, settings.wire, file)
               : static_cast<std::size_t>(bare - channels.names.begin());
  }
  const auto surveys = surveys_of_columns(table, clock, channels, settings.hints);
  for (std::size_t i = 0; i < channels.names.size(); ++i)
    if (is_beyond_range(table, channels.columns[i]))
      facts.assumed.push_back("no line on " + escaped_name(channels.names[i]) +
                              ", which is often beyond its range");
  return take_choice(surveys, facts);
}

/// The file's columns of 0 and 1 that may be read; `column` is one of them.
void open_levels(CsvTable table, const RowClock& clock, const Channels& channels,
                 std::size_t column, Capture& capture) {
  std::vector<std::size_t> columns;
  for (const std::size_t i : channels.columns)
    if (is_logic(table, i)) columns.push_back(i);
  capture.wire = static_cast<std::size_t>(std::ranges::find(columns, column) - columns.begin());
  capture.logic = std::make_unique<CsvLogic>(std::move(table), clock, std::move(columns));
}

}  // namespace

void open_csv(const std::string& file, const CaptureSettings& settings, Capture& capture) {
  CsvTable table(*capture.in, file, settings.skip_rows);
  CaptureFacts& facts = capture.facts;
  const RowClock clock(table, settings, facts);
  const bool is_told =
      settings.sample_rate && !(settings.is_one_of_many && table.head().sample_rate());
  if (const auto& unknown = table.head().unknown(); unknown && !is_told && !clock.has_column())
    table.fail_at(unknown->line, unknown->of + " '" + shown(unknown->word) + "'", unknown->why,
                  "say --sample-rate");
  if (!clock.has_column() && !clock.rate())
    throw bad_input(file + " has no sample rate", "it has no column time either",
                    "say --sample-rate");
  const Channels channels = channels_of(table, clock);
  facts.taken = chosen(table, clock, channels, file, settings, facts);
  facts.is_whole = table.is_whole();
  const std::size_t column = channels.columns[*facts.taken];
  if (is_logic(table, column))
    return open_levels(std::move(table), clock, channels, column, capture);
  const auto pace = pace_of_samples(table, clock);
  if (!pace) table.fail("the rows' times", "an analogue column has 1 to 1e12 rows a second");
  if (is_beyond_range(table, column))
    table.fail_at(table.line_ahead(0), "column " + shown(name_of(table, column)),
                  "its signal is often beyond what the instrument could show",
                  "record it again in a wider range");
  capture.samples = std::make_unique<CsvSamples>(std::move(table), clock, *pace, column);
}

}  // namespace sim
