#include "sim/fit/plan_text.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "sim/capture/text_lines.hpp"
#include "sim/capture/text_mark.hpp"
#include "sim/failure.hpp"
#include "sim/text/list_text.hpp"
#include "sim/text/number_text.hpp"
#include "sim/text/text_file.hpp"

namespace sim {
namespace {

constexpr std::string_view plan_heading = "# A plan of cosys-sim fit, version 1\n";

constexpr const char* format_in_words =
    R"(# A line a step, in order of time; '#' begins a comment; fields are separated by blanks, tabs or commas:
#   start_ms    of its first carrier cycle
#   carrier_hz  of the carrier
#   cycles_on   carrier cycles of light a burst
#   cycles_off  carrier cycles of dark behind each burst; of one burst alone may be 0
#   repeats     bursts
#   level_db    20 log10 of irradiance over that of the first step (twice the distance: -12 dB)
)";

constexpr const char* how_to_write_a_step =
    "write start_ms carrier_hz cycles_on cycles_off repeats level_db";

// What no receiver module and no recording has.
constexpr double longest_ms = 1e8, least_carrier_hz = 1e3, greatest_carrier_hz = 1e7;
constexpr double most_cycles = 1e9, greatest_db = 200;
// Steps whose times are rounded to microseconds may seem to overlap so much.
constexpr double rounding_ms = 2e-3;

/// A column of the text.
struct PlanField {
  const char* name;
  double least, greatest;
  bool is_count;
  const char* why;  // other numbers are refused
};

constexpr PlanField plan_fields[] = {
    {"start_ms", 0, longest_ms, false, "a plan begins at 0 and ends within a day"},
    {"carrier_hz", least_carrier_hz, greatest_carrier_hz, false, "a carrier is 1e3 to 1e7 Hz"},
    {"cycles_on", 1, most_cycles, true, "a burst has 1 to 1e9 cycles"},
    {"cycles_off", 0, most_cycles, true, "a gap has 0 to 1e9 cycles"},
    {"repeats", 1, most_cycles, true, "a step has 1 to 1e9 bursts"},
    {"level_db", -greatest_db, greatest_db, false, "a level is -200 to 200 dB"}};
constexpr std::size_t field_count = std::size(plan_fields);

/// One line of a plan, and how its faults are told.
class PlanLine {
 public:
  PlanLine(std::string_view words, const std::string& file, std::size_t number)
      : file_(file), number_(number) {
    for (const std::string_view cell : split(words, ',')) take(trimmed(cell));
  }

  PlanStep step() const {
    if (fields_.size() != field_count)
      fail(fmt::format("a step of {} fields", fields_.size()), "it has six", how_to_write_a_step);
    PlanStep step{.start_ms = number(0),
                  .carrier_hz = number(1),
                  .cycles_on = count(2),
                  .cycles_off = count(3),
                  .repeats = count(4),
                  .level_db = number(5)};
    if (step.cycles_off == 0 && step.repeats > 1)
      fail(said(4), "bursts without dark between them are one", "give the gap as cycles_off");
    if (!(end_ms(step) <= longest_ms))
      fail(fmt::format("a step that ends at {:g} ms", end_ms(step)), plan_fields[0].why,
           "look at its cycles and repeats");
    return step;
  }

  /// `before` is the step on the line that has this number.
  void refuse_overlap(const PlanStep& before, std::size_t before_number,
                      const PlanStep& step) const {
    if (step.start_ms < before.start_ms)
      fail(said(0), fmt::format("that of line {} begins later", before_number),
           "put steps in order of time");
    if (step.start_ms < end_ms(before) - rounding_ms)
      fail(said(0),
           fmt::format("that of line {} lasts until {:.3f} ms", before_number, end_ms(before)),
           "let it begin then or later");
  }

 private:
  void take(std::string_view cell) {
    do {
      const std::size_t end = cell.find_first_of(" \t");
      fields_.push_back(cell.substr(0, end));
      cell = end == std::string_view::npos ? "" : trimmed(cell.substr(end));
    } while (!cell.empty());
  }

  std::string said(std::size_t field) const {
    return fmt::format("{} = {}", plan_fields[field].name, shown(fields_[field]));
  }

  double number(std::size_t field) const {
    const PlanField& is = plan_fields[field];
    const std::optional<double> value = parse_number(fields_[field]);
    if (!value) fail(said(field), "not a number", how_to_write_a_step);
    if (!(*value >= is.least && *value <= is.greatest))  // NaN is not either
      fail(said(field), is.why, "look for a wrong unit or column");
    if (is.is_count && *value != std::floor(*value))
      fail(said(field), "not a whole number", "write one without a fraction");
    return *value;
  }
  std::uint64_t count(std::size_t field) const { return static_cast<std::uint64_t>(number(field)); }

  [[noreturn]] void fail(const std::string& problem, const std::string& why,
                         const std::string& suggestion) const {
    throw bad_input(fmt::format("{} in {}:{}", problem, file_, number_), why, suggestion);
  }

  const std::string& file_;
  std::size_t number_;
  std::vector<std::string_view> fields_;
};

std::string_view without_comment(std::string_view line) {
  return trimmed(line.substr(0, line.find('#')));
}

void make_relative_to_the_first(Plan& plan) {
  const double first = plan.steps.front().level_db;
  for (PlanStep& step : plan.steps) step.level_db -= first;
}

std::string step_text(const PlanStep& s) {
  return fmt::format("{} {} {} {} {} {}\n", s.start_ms, s.carrier_hz, s.cycles_on, s.cycles_off,
                     s.repeats, s.level_db);
}

}  // namespace

double end_ms(const PlanStep& step) {
  const double cycles = static_cast<double>(step.repeats) * (static_cast<double>(step.cycles_on) +
                                                             static_cast<double>(step.cycles_off));
  return step.start_ms + 1e3 * cycles / step.carrier_hz;
}

std::string plan_text(const Plan& plan, const std::vector<std::string>& remarks) {
  std::string text(plan_heading);
  text += format_in_words;
  for (const std::string& remark : remarks) text += remark.empty() ? "#\n" : "# " + remark + "\n";
  for (const PlanStep& step : plan.steps) text += step_text(step);
  return text;
}

Plan plan_of_text(std::string_view text, const std::string& file) {
  text.remove_prefix(mark_bytes(text, file));
  Plan plan;
  std::size_t number = 0, number_before = 0;
  for (std::string_view line : split(text, '\n')) {
    ++number;
    if (line.ends_with('\r')) line.remove_suffix(1);
    const std::string_view words = without_comment(line);
    if (words.empty()) continue;
    const PlanLine read(words, file, number);
    const PlanStep step = read.step();
    if (!plan.steps.empty()) read.refuse_overlap(plan.steps.back(), number_before, step);
    plan.steps.push_back(step);
    number_before = number;
  }
  if (plan.steps.empty()) throw bad_input(file, "a plan without a step", how_to_write_a_step);
  make_relative_to_the_first(plan);
  return plan;
}

Plan read_plan(const std::filesystem::path& path) {
  constexpr std::size_t longest = 16 * mebibyte;
  return plan_of_text(read_text_file(path, "plan", longest), path.generic_string());
}

bool is_written_plan_text(std::string_view text) { return text.starts_with(plan_heading); }

}  // namespace sim
