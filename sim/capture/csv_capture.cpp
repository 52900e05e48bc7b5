#include "sim/capture/csv_capture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "sim/capture/csv_table.hpp"
#include "sim/capture/sampled_line.hpp"
#include "sim/capture/wire_choice.hpp"
#include "sim/failure.hpp"

namespace sim {
namespace {

using dsp::Hertz;
using dsp::Seconds;
using Row = std::vector<double>;

constexpr double infinity = std::numeric_limits<double>::infinity();

std::string in_small_letters(std::string text) {
  std::ranges::transform(text, text.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  });
  return text;
}

std::string name_of(const CsvTable& table, std::size_t column) {
  const Heading& heading = table.columns()[column];
  return heading.text.empty() ? std::to_string(column) : heading.text;
}

bool is_logic(const CsvTable& table, std::size_t column) {
  return std::ranges::all_of(table.ahead(), [&](const Row& row) {
    return row[column] == 0 || row[column] == 1 || std::isnan(row[column]);
  });
}

/// Never back, and on at last: times may repeat where they are printed with too few digits.
bool rises(const CsvTable& table, std::size_t column) {
  const auto back = [&](const Row& a, const Row& b) { return !(b[column] >= a[column]); };
  const auto& rows = table.ahead();
  return rows.size() > 1 && std::ranges::adjacent_find(rows, back) == rows.end() &&
         rows.back()[column] > rows.front()[column];
}

bool has_time_heading(const Heading& heading) {
  const std::string name = in_small_letters(heading.name);
  return name.starts_with("time") || name == "t" || name == "x" || name == "x-axis" ||
         (name.empty() && time_unit(heading.unit));
}

bool counts_rows(const Heading& heading) {
  const std::string name = in_small_letters(heading.name);
  return name == "index" || name == "sample" || name == "samples" || name == "sample #" ||
         name == "n" || name == "no" || name == "#" || name == "point";
}

/// By its name; else the first that rises, but one that counts rows.
std::optional<std::size_t> time_column(const CsvTable& table) {
  const std::size_t count = table.columns().size();
  for (std::size_t i = 0; i < count; ++i)
    if (has_time_heading(table.columns()[i]) && count > 1) return i;
  for (std::size_t i = 0; i < count && count > 1; ++i)
    if (!counts_rows(table.columns()[i]) && !is_logic(table, i) && rises(table, i)) return i;
  return std::nullopt;
}

/// sigrok prints times as whole numbers of a unit that it does not name: the one in which the rows
/// lie on the head's samples, and not all of them on every tenth or hundredth.
std::optional<double> unit_by_rate(const CsvTable& table, std::size_t column, Hertz rate) {
  double step = 0;
  for (std::size_t i = 1; i < table.ahead().size(); ++i) {
    double rest = table.ahead()[i][column] - table.ahead()[i - 1][column];
    if (rest != std::floor(rest)) return std::nullopt;
    while (rest > 0) step = std::exchange(rest, std::fmod(step, rest));
  }
  for (const double unit : {1e-12, 1e-9, 1e-6, 1e-3, 1.0})
    if (step * unit * rate.value > 0.999) return unit;
  return std::nullopt;
}

/// The instants of rows.
class RowClock {
 public:
  RowClock(const CsvTable& table, const CaptureSettings& settings, CaptureFacts& facts)
      : rate_(settings.sample_rate ? settings.sample_rate : table.sample_rate()),
        column_(time_column(table)) {
    if (!column_) {
      if (rate_) facts.time = fmt::format("{:g} rows a second", rate_->value);
      return;
    }
    find_unit(table, settings, facts);
    const double start = table.ahead().front()[*column_] * unit_;
    if (start < 0 || start > longest_before_start) origin_ = start;
    if (origin_ > 0) facts.assumed.push_back(fmt::format("times count from {:.6f} s on", origin_));
  }

  bool has_column() const { return column_.has_value(); }
  std::optional<std::size_t> column() const { return column_; }
  std::optional<Hertz> rate() const { return rate_; }

  /// Of the next row.
  Seconds next(const CsvTable& table, const Row& row) {
    const double index = static_cast<double>(count_++);
    const Seconds at(column_ ? row[*column_] * unit_ - origin_ : index / rate_->value);
    if (!(at >= now_)) table.fail("a row's time", "it is before that of the row before");
    if (at > longest_capture) table.fail("a row's time", "it is after more than 30 years");
    return now_ = at;
  }

  Seconds now() const { return now_; }

 private:
  static constexpr double longest_before_start = 1e6;  // s; more is a date

  void find_unit(const CsvTable& table, const CaptureSettings& settings, CaptureFacts& facts) {
    const Heading& heading = table.columns()[*column_];
    const auto by_rate = rate_ ? unit_by_rate(table, *column_, *rate_) : std::nullopt;
    if (settings.tick) {
      unit_ = settings.tick->value;
    } else if (!heading.unit.empty()) {
      const auto unit = time_unit(heading.unit);
      if (!unit)
        table.fail("the time's unit '" + shown(heading.unit) + "'", "no such unit is known here");
      unit_ = unit->value;
    } else if (by_rate) {
      unit_ = *by_rate;
      facts.assumed.emplace_back("the unit of time in which rows lie on samples");
    } else {
      facts.assumed.emplace_back("time in seconds");
    }
    facts.time = unit_ == 1 ? "time in s" : fmt::format("time in steps of {:g} s", unit_);
  }

  std::optional<Hertz> rate_;
  std::optional<std::size_t> column_;
  double unit_ = 1, origin_ = 0;
  std::uint64_t count_ = 0;
  Seconds now_;
};

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

  /// Nothing where the cell says nothing.
  std::optional<bool> level_of(std::size_t wire) const {
    const double value = row_[columns_[wire]];
    if (std::isnan(value)) return std::nullopt;
    if (value != 0 && value != 1)
      table_.fail(fmt::format("the value {}", value),
                  "column " + wires_[wire] + " was 0 or 1 so far");
    return value == 1;
  }

  CsvTable table_;
  RowClock clock_;
  std::vector<std::size_t> columns_;
  std::vector<std::string> wires_;
  std::vector<std::optional<bool>> levels_;
  Row row_;
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
      const double value = (*row)[column_];
      if (!std::isnan(value)) last_ = static_cast<float>(value);
      to[count] = last_;  // as before where the cell says nothing
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
  float last_ = 0;
  std::uint64_t count_ = 0;
  std::optional<Seconds> first_;
};

/// A column of the rows at hand, as samples.
class ColumnAhead : public SampleCapture {
 public:
  ColumnAhead(const CsvTable& table, Hertz rate, std::size_t column)
      : table_(table), rate_(rate), column_(column) {}

  Hertz sample_rate() const override { return rate_; }
  bool is_complex() const override { return false; }

  std::size_t read(std::span<std::complex<float>> to) override {
    std::size_t count = 0;
    for (; count < to.size() && next_ < table_.ahead().size(); ++count, ++next_) {
      const double value = table_.ahead()[next_][column_];
      if (!std::isnan(value)) last_ = static_cast<float>(value);
      to[count] = last_;
    }
    return count;
  }

 private:
  const CsvTable& table_;
  Hertz rate_;
  std::size_t column_, next_ = 0;
  float last_ = 0;
};

WireSurvey survey_of_samples(const CsvTable& table, Hertz rate, std::size_t column,
                             const LineHints& hints) {
  WireSurvey survey{name_of(table, column), 0, {}};
  double least = infinity, most = -infinity;
  for (const Row& row : table.ahead()) {
    least = std::fmin(least, row[column]);
    most = std::fmax(most, row[column]);
  }
  if (!(most > least)) return survey;
  ColumnAhead samples(table, rate, column);
  SampledLine line(samples, {hints.carrier, hints.baud});
  std::vector<Seconds> flips;
  while (const auto flip = line.next()) flips.push_back(*flip);
  survey.edges = flips.size();
  survey.facts =
      survey_line({line.initial(), flips, line.known_until()}, hints.inverted, hints.baud);
  return survey;
}

WireSurvey survey_of_levels(const CsvTable& table, std::size_t column) {
  WireSurvey survey{name_of(table, column), 0, {}};
  std::optional<double> last;
  for (const Row& row : table.ahead()) {
    if (std::isnan(row[column])) continue;
    survey.edges += last && *last != row[column];
    last = row[column];
  }
  return survey;
}

/// Columns but the time; those of 0 and 1 alone are wires, as long as one of them moves.
struct Columns {
  std::vector<std::size_t> logic, analogue;
  std::vector<WireSurvey> surveys;  // of both, logic first
};

Columns columns_of(const CsvTable& table, const RowClock& clock, std::optional<Hertz> rate,
                   const LineHints& hints) {
  Columns columns;
  for (std::size_t i = 0; i < table.columns().size(); ++i)
    if (i != clock.column()) (is_logic(table, i) ? columns.logic : columns.analogue).push_back(i);
  for (const std::size_t i : columns.logic) columns.surveys.push_back(survey_of_levels(table, i));
  for (const std::size_t i : columns.analogue)
    columns.surveys.push_back(rate && is_sample_rate(*rate)
                                  ? survey_of_samples(table, *rate, i, hints)
                                  : WireSurvey{name_of(table, i), 0, {}});
  return columns;
}

/// Without its unit: "CH1" of "CH1 (V)".
std::string bare_name(const WireSurvey& survey) { return heading_of(survey.name).name; }

/// The place among the surveys of the column that is read as samples; nothing where wires are.
std::optional<std::size_t> analogue_choice(const Columns& columns, const std::string& wanted,
                                           const std::string& file, CaptureFacts& facts) {
  const std::size_t n_logic = columns.logic.size();
  if (!wanted.empty()) {
    std::vector<std::string> names;
    for (const WireSurvey& survey : columns.surveys) names.push_back(survey.name);
    const auto bare = std::ranges::find(columns.surveys, wanted, bare_name);
    const std::size_t named = bare == columns.surveys.end()
                                  ? named_wire(names, wanted, file)
                                  : static_cast<std::size_t>(bare - columns.surveys.begin());
    return named < n_logic ? std::nullopt : std::optional(named);
  }
  const bool wires_move =
      std::ranges::any_of(std::span(columns.surveys).first(n_logic),
                          [](const WireSurvey& survey) { return survey.edges > 0; });
  const auto analogue = std::span(columns.surveys).subspan(n_logic);
  if (analogue.empty() || wires_move) return std::nullopt;
  const WireChoice choice = choice_of_wire({analogue.begin(), analogue.end()});
  if (analogue[choice.wire].edges == 0 && n_logic > 0) return std::nullopt;
  if (choice.rival) facts.rival = analogue[*choice.rival].name;
  return n_logic + choice.wire;
}

}  // namespace

void open_csv(const std::string& file, const CaptureSettings& settings, Capture& capture) {
  CsvTable table(*capture.in, file, settings.skip_rows);
  const RowClock clock(table, settings, capture.facts);
  const auto rate = clock.rate() ? clock.rate() : measured_rate(table, clock);
  if (!clock.has_column() && !rate)
    throw bad_input(file + " has no sample rate", "it has no column time either",
                    "say --sample-rate");
  Columns columns = columns_of(table, clock, rate, settings.hints);
  const auto analogue = analogue_choice(columns, settings.wire, file, capture.facts);
  for (const WireSurvey& survey : columns.surveys)
    capture.facts.channels.push_back({survey.name, survey.edges});
  capture.facts.is_whole = table.is_whole();
  if (!analogue) {
    capture.logic = std::make_unique<CsvLogic>(std::move(table), clock, columns.logic);
    return;
  }
  if (!rate || !is_sample_rate(*rate))
    table.fail("the rows' times", "an analogue column has 1 to 1e12 rows a second");
  capture.facts.channel = columns.surveys[*analogue].name;
  const std::size_t column = columns.analogue[*analogue - columns.logic.size()];
  capture.samples = std::make_unique<CsvSamples>(std::move(table), clock, *rate, column);
}

}  // namespace sim
