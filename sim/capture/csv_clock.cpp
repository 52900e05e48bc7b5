#include "sim/capture/csv_clock.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "sim/capture/capture_units.hpp"
#include "sim/capture/csv_columns.hpp"

namespace sim {
namespace {

using dsp::Hertz;
using dsp::Seconds;

constexpr double longest_before_start = 1e6;  // s; more is a date
constexpr double last_date = 4.1e9;           // s, in the year 2099

/// Of the times of the rows ahead, the step of which all distances are whole multiples; nothing
/// where times are no whole numbers.
std::optional<double> step_of(const CsvTable& table, std::size_t column) {
  double step = 0;
  for (std::size_t row = 1; row < table.rows_ahead(); ++row) {
    double rest = table.ahead(row, column) - table.ahead(row - 1, column);
    if (rest != std::floor(rest)) return std::nullopt;
    while (rest > 0) step = std::exchange(rest, std::fmod(step, rest));
  }
  return step;
}

/// What a tick is of sigrok's times. It prints the number of the sample times the whole ticks in a
/// sample, of a unit that it may not name: at 24 MHz 41, 82, 123 ns (libsigrok, src/output/csv.c).
/// The unit is the finest in which all rows lie on samples.
std::optional<double> tick_of_sigrok(const CsvTable& table, std::size_t column, Hertz rate) {
  const auto step = step_of(table, column);
  if (!step || *step == 0) return std::nullopt;
  const auto named = time_unit(table.columns()[column].unit);
  for (const double unit : {1e-12, 1e-9, 1e-6, 1e-3, 1.0}) {
    const double ticks_a_sample = std::floor(1 / (unit * rate.value) + 1e-6);
    const bool is_it = !named || std::abs(named->value / unit - 1) < 1e-6;
    if (is_it && ticks_a_sample >= 1 && std::fmod(*step, ticks_a_sample) == 0)
      return 1 / (ticks_a_sample * rate.value);
  }
  return std::nullopt;
}

double named_unit(const CsvTable& table, const std::string& named) {
  const auto unit = time_unit(named);
  if (!unit)
    table.fail_at(table.head().line_of_units(table.place()),
                  "the time's unit '" + shown(named) + "'", "no such unit is known here");
  return unit->value;
}

void refuse_unit_of_no_column(const CsvTable& table) {
  if (const auto unit = table.head().unit_of_no_column(table.place()))
    table.fail_at(unit->line, unit->of + " '" + shown(unit->word) + "'", unit->why,
                  "say --time-unit " + shown(unit->word) + ", or s");
}

}  // namespace

RowClock::RowClock(const CsvTable& table, const CaptureSettings& settings, CaptureFacts& facts)
    : column_(time_column(table)) {
  rate_ = column_ && settings.is_one_of_many ? table.head().sample_rate()
                                             : settings.rate_over(table.head().sample_rate());
  if (!column_) {
    if (rate_) facts.time = samples_text(*rate_);
    return;
  }
  const bool is_named = is_of_time(table.columns()[*column_]);
  if (settings.sample_rate && is_named && !settings.is_one_of_many && !table.head().is_of_sigrok())
    table.fail_at(table.head().line_of_units(table.place()), "--sample-rate",
                  "rows have times of their own", "leave it out");
  if (settings.sample_rate && !is_named) {  // it may be anything that rises
    column_.reset();
    rate_ = settings.rate_over(table.head().sample_rate());
    facts.time = samples_text(*rate_);
    return;
  }
  find_unit(table, settings, facts);
  const double start = table.ahead(0, *column_) * unit_;
  if (start > last_date)
    table.fail_at(table.line_ahead(0), fmt::format("a time of {:.10g} s", start),
                  "it is after the year 2099", "say --time-unit ms, or what their unit is");
  if (start < 0 || start > longest_before_start) origin_ = start;
  if (origin_ > 0) facts.assumed.push_back(fmt::format("times count from {:.6f} s on", origin_));
}

Seconds RowClock::next(const CsvTable& table, const std::vector<double>& row, std::size_t line) {
  const double index = static_cast<double>(count_++);
  const Seconds at(column_ ? row[*column_] * unit_ - origin_ : index / rate_->value);
  const char* fault = std::isnan(at.value)   ? "it is no number"
                      : at < now_            ? "it is before that of the row before"
                      : at > longest_capture ? "it is after more than 30 years"
                                             : nullptr;
  if (fault != nullptr) table.fail_at(line, "a row's time", fault);
  return now_ = at;
}

void RowClock::find_unit(const CsvTable& table, const CaptureSettings& settings,
                         CaptureFacts& facts) {
  const std::string& named = table.columns()[*column_].unit;
  const bool is_said = !named.empty() || (rate_ && table.head().is_of_sigrok()) ||
                       table.head().unit_of_no_column(table.place());
  if (settings.tick && !(is_said && settings.is_one_of_many)) {
    unit_ = settings.tick->value;
  } else if (rate_ && table.head().is_of_sigrok()) {
    const auto tick = tick_of_sigrok(table, *column_, *rate_);
    unit_ = tick ? *tick : named_unit(table, named.empty() ? "s" : named);
    if (named.empty()) facts.assumed.emplace_back("the unit of time in which rows lie on samples");
  } else if (!named.empty()) {
    unit_ = named_unit(table, named);
  } else {
    refuse_unit_of_no_column(table);
    facts.assumed.emplace_back("time in seconds");
    facts.is_tick_assumed = true;
    return;
  }
  facts.time = ticks_text(Seconds(unit_));
}

}  // namespace sim
