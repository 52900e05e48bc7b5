// What a check says on a page of a CI server, as Markdown: no pictures of others are shown there,
// so those of frames are characters.
#include <fmt/format.h>

#include <algorithm>

#include "sim/check/check_report.hpp"
#include "sim/check/frame_picture.hpp"
#include "sim/counting/statistics.hpp"
#include "sim/text/existing_file.hpp"

namespace sim {
namespace {

constexpr std::string_view summary_head = "## Receiver gate: ";

/// A cell must not end one.
std::string cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2)
    text.insert(at, "\\");
  return text;
}

std::string lost_cell(const FrameCounts& counts) {
  if (counts.frames == 0) return "-";
  return fmt::format("{} ({:.2f} %)", counts.lost, 100 * ratio(counts.lost, counts.frames));
}

std::string point_line(const PointCheck& check) {
  const char* mark = check.verdict == Verdict::passed         ? "✅"
                     : check.verdict == Verdict::inconclusive ? "❔"
                                                              : "❌";
  return fmt::format("| {} {} | {} | {} | {} | {} | {} |\n", mark, name(check.verdict),
                     cell(check.point.name), check.candidate.frames, lost_cell(check.baseline),
                     lost_cell(check.candidate), check.candidate.undetected_error);
}

std::string point_lines(const CheckReport& report) {
  std::string text =
      "| verdict | point | frames | lost by the baseline | by the decoder | accepted wrongly |\n"
      "|---|---|---:|---:|---:|---:|\n";
  for (const PointCheck& check : report.checks) text += point_line(check);
  return text;
}

/// Frames that the candidate alone got wrong.
std::vector<std::uint32_t> wrong_frames(const PointCheck& check) {
  std::vector<std::uint32_t> frames = check.only_candidate_lost;
  frames.insert(frames.end(), check.only_candidate_undetected.begin(),
                check.only_candidate_undetected.end());
  return frames;
}

/// The first of each bad point, the worst point first; then the second of each.
std::vector<std::pair<const PointCheck*, std::uint32_t>> worst_frames(const CheckReport& report) {
  constexpr std::size_t most = 3;
  std::vector<const PointCheck*> bad;
  for (const PointCheck& check : report.checks)
    if (check.verdict == Verdict::worse) bad.push_back(&check);
  std::ranges::sort(bad, {}, [](const PointCheck* check) {
    return std::min(check->p_lost, check->p_undetected);
  });
  std::vector<std::pair<const PointCheck*, std::uint32_t>> worst;
  for (std::size_t i = 0; i < most; ++i)
    for (const PointCheck* check : bad)
      if (const auto frames = wrong_frames(*check); i < frames.size() && worst.size() < most)
        worst.emplace_back(check, frames[i]);
  return worst;
}

std::string frame_section(const CheckReport& report, const PointCheck& check, std::uint32_t trial) {
  const OneFrame frame = hear_frame(check.point, trial);
  const bool is_lost = std::ranges::binary_search(check.only_candidate_lost, trial);
  return fmt::format("\n**{}, frame {}**: {}\n\n```text\n{}```\n\n`{} --explain {}`\n",
                     check.point.name, trial,
                     is_lost ? "lost" : "another message was accepted in its place",
                     frame_picture(frame), repeat_command(report, check), trial);
}

std::string fault_sections(const CheckReport& report) {
  std::string text;
  for (const PointCheck& check : report.checks)
    if (check.fault)
      text += fmt::format("\n**{}**: the decoder failed: {}\n\n```text\n{}\n```\n",
                          check.point.name, check.fault->what, check.fault->words);
  return text;
}

}  // namespace

std::string check_summary(const CheckReport& report) {
  std::string text =
      fmt::format("{}{}\n\n`{}` against `{}`, the baseline of {}. {}\n", summary_head,
                  name(verdict_of(report.checks)), report.setup.candidate.name(),
                  report.baseline.decoder, report.baseline_file.string(), verdict_line(report));
  text += point_lines(report) + fault_sections(report);
  const auto worst = worst_frames(report);
  if (!worst.empty()) text += "\n### Frames to look at\n";
  for (const auto& [check, trial] : worst) text += frame_section(report, *check, trial);
  return text;
}

bool is_check_summary(const std::filesystem::path& path) {
  return beginning_of(path, summary_head.size()) == summary_head;
}

}  // namespace sim
