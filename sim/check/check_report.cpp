#include "sim/check/check_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/columns/estimate_text.hpp"
#include "sim/columns/text_table.hpp"
#include "sim/counting/statistics.hpp"
#include "sim/text/escaped_text.hpp"
#include "sim/text/list_text.hpp"
#include "sim/text/shell_text.hpp"

namespace sim {
namespace {

constexpr int percent_width = 9;

std::string percent(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? "-" : fmt::format("{:.2f} %", 100 * ratio(part, whole));
}

std::string count_or_dash(const PointCheck& check, std::uint64_t count) {
  return check.pairing == Pairing::unpaired ? "-" : std::to_string(count);
}

std::vector<TextColumn> columns_for(const std::vector<PointCheck>& checks) {
  std::size_t width = 5;
  for (const PointCheck& check : checks) width = std::max(width, check.point.name.size());
  return {{{"", "", "point"}, -static_cast<int>(width)},
          {{"", "frames", "judged"}, 7},
          {{"lost by", "the", "baseline"}, percent_width},
          {{"lost by", "the", "candidate"}, percent_width},
          {{"by the", "candidate", "alone"}, percent_width},
          {{"by the", "baseline", "alone"}, percent_width},
          {{"", "", "p"}, 7},
          {{"", "", "verdict"}, -12}};
}

std::vector<std::string> row_of(const PointCheck& c) {
  return {c.point.name,
          std::to_string(c.candidate.frames),
          percent(c.baseline.lost, c.baseline.frames),
          percent(c.candidate.lost, c.candidate.frames),
          count_or_dash(c, c.losses.candidate_only),
          count_or_dash(c, c.losses.baseline_only),
          fmt::format("{:.2g}", std::min({1.0, c.p_lost, c.p_undetected})),
          name(c.verdict)};
}

std::string interval_text(std::uint64_t part, std::uint64_t whole) {
  const Interval i = clopper_pearson(static_cast<double>(part), static_cast<double>(whole), 0.95);
  return estimate_text({ratio(part, whole), i.low, i.high});
}

std::string counts_line(const char* who, const FrameCounts& counts) {
  return fmt::format("{}: {} of {} frames lost, {}; {} accepted wrongly\n", who, counts.lost,
                     counts.frames, interval_text(counts.lost, counts.frames),
                     counts.undetected_error);
}

std::string list_of(const char* what, const std::vector<std::uint32_t>& trials) {
  constexpr std::size_t most = 20;
  if (trials.empty()) return "";
  const auto shown = trials.begin() + static_cast<std::ptrdiff_t>(std::min(most, trials.size()));
  return fmt::format("{}: {}{}\n", what, fmt::join(trials.begin(), shown, ", "),
                     trials.size() > most ? fmt::format(" ... ({} in all)", trials.size()) : "");
}

std::string fault_lines(const DecoderFault& fault) {
  std::string text = "the decoder failed: " + fault.what + "\n";
  for (const std::string_view line : split(fault.words, '\n'))
    if (!line.empty()) text += fmt::format("  | {}\n", escaped(line));
  return text;
}

const char* pairing_line(Pairing pairing) {
  switch (pairing) {
    case Pairing::stored:
      return "";
    case Pairing::decoded:
      return "the light is not the baseline's: its decoder has decoded the new one\n";
    case Pairing::unpaired:
      return "the light is not the baseline's, whose decoder is a program: counts are compared\n";
  }
  return "";
}

/// What a trial is looked at for.
const std::vector<std::uint32_t>& telling_frames(const PointCheck& check) {
  return check.only_candidate_lost.empty() ? check.only_candidate_undetected
                                           : check.only_candidate_lost;
}

/// What would end a doubt.
std::string wish(const CheckReport& report, const PointCheck& check) {
  if (check.no_worse)
    return fmt::format(
        "{} accepted wrongly, {} by the baseline, by chance in one of {:.0f} checks; "
        "more frames would tell\n",
        check.candidate.undetected_error, check.baseline.undetected_error, 1 / check.p_undetected);
  if (check.frames_needed > 0) return fmt::format("{} frames would tell\n", check.frames_needed);
  return fmt::format("{} frames, none of them lost, would show that it loses less than {:g} %\n",
                     frames_to_be_negligible(report.setup.rule),
                     100 * report.setup.rule.negligible);
}

std::string words_about(const CheckReport& report, const PointCheck& check) {
  if (check.verdict == Verdict::passed) return "";
  if (check.verdict == Verdict::inconclusive) return check.point.name + ": " + wish(report, check);
  return fmt::format("\n{}: {}\n{}", check.point.name, name(check.verdict),
                     point_details(report, check));
}

std::string trace_command_of(const CheckReport& report, const PointCheck& check,
                             std::uint32_t trial) {
  return fmt::format("cosys-sim trace {} --point {} --trial {}{} -o frame{}.vcd",
                     shell_word(check.point.file.string()), check.point.number, trial,
                     report.scenario_options, trial);
}

std::string head(const CheckReport& report) {
  return fmt::format("{} against {}, the baseline of {} ({} {})\n", report.setup.candidate.name(),
                     report.baseline.decoder, report.baseline_file.string(),
                     report.baseline.program.version, report.baseline.program.commit);
}

std::string power_lines(const CheckReport& report) {
  const SequentialTestRule& rule = report.setup.rule;
  std::size_t known = 0, enough = 0;
  const PointCheck* most = nullptr;
  for (const PointCheck& check : report.checks) {
    if (std::isnan(check.power)) continue;
    ++known;
    enough += check.frames_needed <= check.limit;
    if (most == nullptr || check.frames_needed > most->frames_needed) most = &check;
  }
  if (known == 0) return "";
  return fmt::format(
      "power: a decoder that loses {:g} times as many is found, and one that loses as many passes, "
      "with probability {:g} or more at {} of {} points where some are lost, not all; most frames "
      "are needed at {}: {}\n",
      rule.worse_than, rule.power, enough, known, most->point.name, most->frames_needed);
}

}  // namespace

std::size_t CheckReport::count(Verdict verdict) const {
  return static_cast<std::size_t>(std::ranges::count(checks, verdict, &PointCheck::verdict));
}

const char* name(Verdict verdict) {
  switch (verdict) {
    case Verdict::passed:
      return "passed";
    case Verdict::worse:
      return "worse";
    case Verdict::inconclusive:
      return "inconclusive";
    case Verdict::broken:
      return "failed";
  }
  return "";
}

std::string verdict_line(const CheckReport& report) {
  const std::size_t points = report.checks.size();
  switch (verdict_of(report.checks)) {
    case Verdict::broken:
      return fmt::format("failed: the decoder did not do its work at {} of {} points\n",
                         report.count(Verdict::broken), points);
    case Verdict::worse:
      return report.setup.golden
                 ? fmt::format("different: {} of {} points\n", report.count(Verdict::worse), points)
                 : fmt::format(
                       "worse: {} of {} points (if none were, so it would be said of one "
                       "check in {:.0f} at most)\n",
                       report.count(Verdict::worse), points, 1 / report.setup.rule.alpha);
    case Verdict::inconclusive:
      return fmt::format("inconclusive: {} of {} points would take more frames\n",
                         report.count(Verdict::inconclusive), points);
    case Verdict::passed:
      break;
  }
  return fmt::format("passed: {} point{}\n", points, points == 1 ? "" : "s");
}

std::string repeat_command(const CheckReport& report, const PointCheck& check) {
  return fmt::format("cosys-sim check {} --point {}{}", shell_word(check.point.file.string()),
                     check.point.number, report.options);
}

std::string point_details(const CheckReport& report, const PointCheck& check) {
  std::string text;
  if (check.fault)
    text += fault_lines(*check.fault);
  else
    text += counts_line("baseline", check.baseline) + counts_line("candidate", check.candidate);
  text += pairing_line(check.pairing);
  if (check.verdict == Verdict::inconclusive) text += wish(report, check);
  text += list_of("lost by the candidate alone", check.only_candidate_lost);
  text += list_of("lost by the baseline alone", check.only_baseline_lost);
  text += list_of("accepted wrongly by the candidate alone", check.only_candidate_undetected);
  text += "again: " + repeat_command(report, check) + "\n";
  if (!telling_frames(check).empty()) {
    const std::uint32_t trial = telling_frames(check).front();
    text += fmt::format("look at one: {} --explain {}\n", repeat_command(report, check), trial);
    text += "its waveform: " + trace_command_of(report, check, trial) + "\n";
  }
  return text;
}

std::string check_text(const CheckReport& report) {
  const std::vector<TextColumn> columns = columns_for(report.checks);
  std::string text = head(report) + table_head(columns);
  for (const PointCheck& check : report.checks) text += table_line(columns, row_of(check));
  for (const PointCheck& check : report.checks) text += words_about(report, check);
  return text + power_lines(report) + verdict_line(report);
}

}  // namespace sim
