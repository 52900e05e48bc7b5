#include "sim/ranking.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "sim/validity.hpp"

namespace sim {
namespace {

using Kind = Crossing::Kind;
constexpr std::size_t none = Ranking::none;

bool is_grid_with_abscissa(const std::vector<Axis>& axes) {
  if (axes.size() == 1) return !axes[0].is_text();
  return axes.size() == 2 && !(axes[0].is_text() && axes[1].is_text());
}

/// The axes of a ranking, without its rows.
Ranking axes_of(const std::vector<Axis>& axes) {
  if (!is_grid_with_abscissa(axes)) return {};
  if (axes.size() == 1) return {.abscissa = 0, .other = none, .rows = {}};
  const std::size_t abscissa = axes[1].is_text() ? 0 : 1;
  return {.abscissa = abscissa, .other = 1 - abscissa, .rows = {}};
}

/// One line of the grid as an experiment of its own.
ExperimentResult row_of(const ExperimentResult& result, const Ranking& at, std::size_t row) {
  ExperimentResult line;
  line.ci_level = result.ci_level;
  line.axes = {result.axes[at.abscissa]};
  for (const PointResult& p : result.points) {
    if (at.other != none && p.coordinates[at.other] != result.axes[at.other].values[row]) continue;
    line.points.push_back(p);
    line.points.back().coordinates = {p.coordinates[at.abscissa]};
  }
  return line;
}

std::uint64_t outside_of(const ExperimentResult& line) {
  std::uint64_t all = 0;
  for (const PointResult& p : line.points) all |= p.outside;
  return all;
}

double loss_at(const ExperimentResult& result, std::size_t axis, double coordinate) {
  double frames = 0, lost = 0;
  for (const PointResult& p : result.points) {
    if (p.coordinates[axis] != coordinate) continue;
    frames += static_cast<double>(p.tally.n_frames);
    lost += static_cast<double>(p.tally.n_frames_lost);
  }
  return frames > 0 ? lost / frames : 0;
}

/// Whether more of the abscissa means less loss, all rows together.
bool more_is_better(const ExperimentResult& result, std::size_t abscissa) {
  const auto [low, high] = std::ranges::minmax(result.axes[abscissa].values);
  return loss_at(result, abscissa, low) > loss_at(result, abscissa, high);
}

/// What a row is sorted by: larger is better.
double merit(const Crossing& c, bool more_better) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double almost = std::numeric_limits<double>::max();
  switch (c.kind) {
    case Kind::all_below:
      return infinity;
    case Kind::all_above:
      return -infinity;
    case Kind::fitted:
    case Kind::jump:
    case Kind::unfitted:
      return more_better ? -c.at : c.at;
    case Kind::unclear:
    case Kind::not_monotone:
      break;
  }
  return -almost;
}

void sort_best_first(Ranking& ranking, bool more_better) {
  std::ranges::stable_sort(ranking.rows, [=](const RowCrossing& a, const RowCrossing& b) {
    return merit(a.crossing, more_better) > merit(b.crossing, more_better);
  });
}

/// "TSOP4856 " padded to the longest of them.
std::string padded(const std::string& label, const std::vector<std::string>& labels) {
  std::size_t widest = 0;
  for (const std::string& other : labels) widest = std::max(widest, other.size());
  return fmt::format("{:<{}}", label, widest);
}

/// What the table marks at points of the row.
std::string mark(const RowCrossing& row) {
  return row.outside == 0 ? "" : "  ! " + validity_names(row.outside);
}

std::string list_of_texts(const ExperimentResult& result, const Ranking& ranking, double level) {
  const Axis &texts = result.axes[ranking.other], &abscissa = result.axes[ranking.abscissa];
  std::string text = fmt::format("{}, best first, by the {} at which frame loss passes {:g} %\n",
                                 texts.key, abscissa.key, level * 100);
  int place = 0;
  for (const RowCrossing& row : ranking.rows)
    text += fmt::format("{:>4}  {}  {}{}\n", ++place, padded(texts.labels[row.row], texts.labels),
                        crossing_words(abscissa, row.crossing, level), mark(row));
  return text;
}

std::string sentences(const ExperimentResult& result, const Ranking& ranking, double level) {
  const Axis& abscissa = result.axes[ranking.abscissa];
  std::string text;
  for (const RowCrossing& row : ranking.rows) {
    if (ranking.other != none) {
      const Axis& other = result.axes[ranking.other];
      text += quantity(other, fmt::format("{:g}", other.values[row.row])) + ": ";
    }
    text += crossing_sentence(abscissa, row.crossing, level) + mark(row) + "\n";
  }
  return text;
}

}  // namespace

Ranking rank(const ExperimentResult& result, double level) {
  Ranking ranking = axes_of(result.axes);
  if (ranking.abscissa == none) return ranking;
  const std::size_t n = ranking.other == none ? 1 : result.axes[ranking.other].values.size();
  for (std::size_t row = 0; row < n; ++row) {
    const ExperimentResult line = row_of(result, ranking, row);
    ranking.rows.push_back({row, frame_loss_crossing(line, level), outside_of(line)});
  }
  if (ranking.other != none && result.axes[ranking.other].is_text())
    sort_best_first(ranking, more_is_better(result, ranking.abscissa));
  return ranking;
}

std::string ranking_lines(const ExperimentResult& result, const Ranking& ranking, double level) {
  if (ranking.rows.empty()) return "";
  const bool texts = ranking.other != none && result.axes[ranking.other].is_text();
  return texts ? list_of_texts(result, ranking, level) : sentences(result, ranking, level);
}

}  // namespace sim
