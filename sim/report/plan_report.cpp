#include "sim/report/plan_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/columns/text_table.hpp"

namespace sim {

std::string duration_text(double seconds) {
  constexpr double minute = 60, hour = 60 * minute, day = 24 * hour;
  if (seconds < 9.95) return fmt::format("{:.2g} s", seconds);
  if (seconds < minute - 0.5) return fmt::format("{:.0f} s", seconds);
  if (seconds < hour - 0.5)
    return fmt::format("{} min {} s", std::lround(seconds) / 60, std::lround(seconds) % 60);
  const long minutes = std::lround(seconds / minute);
  if (seconds < 2 * day) return fmt::format("{} h {} min", minutes / 60, minutes % 60);
  return fmt::format("{:.0f} days", seconds / day);
}

std::string plan_table(const std::vector<Axis>& axes, const std::vector<Pilot>& pilots,
                       int threads) {
  std::vector<TextColumn> columns = axis_columns(axes);
  columns.push_back({{"", "frames", "at most"}, number_width});
  columns.push_back({{"", "frames", "expected"}, number_width});
  columns.push_back({{"", "", "time"}, number_width});
  std::string text = table_head(columns);
  double frames = 0;
  for (const Pilot& pilot : pilots) {
    std::vector<std::string> texts = coordinate_texts(axes, pilot.coordinates);
    texts.push_back(std::to_string(pilot.rule.max_frames));
    texts.push_back(fmt::format("{:.0f}", expected_frames(pilot)));
    texts.push_back(duration_text(expected_seconds(pilot)));
    text += table_line(columns, texts);
    frames += expected_frames(pilot);
  }
  return text + fmt::format("{} point{}: about {:.0f} frames, {} on {} threads\n", pilots.size(),
                            pilots.size() == 1 ? "" : "s", frames,
                            duration_text(expected_seconds(pilots)), threads);
}

std::string plan_table(const std::vector<Axis>& axes, const std::vector<RunPilot>& pilots,
                       int threads) {
  std::vector<TextColumn> columns = axis_columns(axes);
  const bool at_most = std::ranges::any_of(pilots, &RunPilot::is_at_most);
  columns.push_back({{"", at_most ? "runs" : "", at_most ? "at most" : "runs"}, number_width});
  columns.push_back({{"", "", "time"}, number_width});
  std::string text = table_head(columns);
  std::uint64_t runs = 0;
  double seconds = 0;
  for (const RunPilot& pilot : pilots) {
    std::vector<std::string> texts = coordinate_texts(axes, pilot.coordinates);
    texts.push_back(std::to_string(pilot.runs));
    texts.push_back(duration_text(pilot.seconds()));
    text += table_line(columns, texts);
    runs += pilot.runs;
    seconds += pilot.seconds();
  }
  return text + fmt::format("{} point{}: {}{} runs, {} on {} threads\n", pilots.size(),
                            pilots.size() == 1 ? "" : "s", at_most ? "at most " : "", runs,
                            duration_text(seconds), threads);
}

}  // namespace sim
