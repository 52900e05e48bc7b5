#include "sim/picture/share_bars.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <functional>
#include <numeric>

#include "sim/picture/scale.hpp"
#include "sim/picture/svg.hpp"
#include "sim/text/letters.hpp"

namespace sim {
namespace {

// Pixels.
constexpr double bars_top = 60, bar_length = 530, bars_margin = 20;
constexpr double least_left = 170, letter_width = 6.5, beside_label = 8;
constexpr double row_step = 20, bar_height = 14;
constexpr double bars_legend_step = 16, bars_patch = 10;

constexpr std::array styles{"fill0", "fill1", "fill2", "fill3", "fill4",
                            "fill5", "fill6", "fill7", "fill8"};

/// Bars begin behind the longest label.
struct Columns {
  explicit Columns(const ShareBars& bars) {
    for (const ShareRow& row : bars.rows)
      left = std::max(left, bars_margin + beside_label +
                                letter_width * static_cast<double>(letters_in(row.label)));
  }
  double left = least_left;
  double right() const { return left + bar_length; }
};

double bottom_of(const ShareBars& bars) {
  return bars_top + row_step * static_cast<double>(bars.rows.size());
}

void draw_row(SvgDrawing& drawing, const Columns& columns, const ShareRow& row, double y) {
  assert(row.counts.size() <= styles.size());
  const auto whole = std::accumulate(row.counts.begin(), row.counts.end(), std::uint64_t{0});
  drawing.text({columns.left - beside_label, y + bar_height - 3}, row.label, "end");
  drawing.rectangle({columns.left, y}, bar_length, bar_height, "frame");
  const Scale across{0, static_cast<double>(std::max<std::uint64_t>(whole, 1)), columns.left,
                     columns.right()};
  std::uint64_t before = 0;
  for (std::size_t kind = 0; kind < row.counts.size(); ++kind) {
    const double from = across(static_cast<double>(before));
    before += row.counts[kind];
    const double to = across(static_cast<double>(before));
    if (to > from) drawing.rectangle({from, y}, to - from, bar_height, styles[kind]);
  }
}

void draw_scale(SvgDrawing& drawing, const Columns& columns, double bottom) {
  for (const int percent : {0, 25, 50, 75, 100}) {
    const double x = columns.left + bar_length * percent / 100;
    drawing.line({x, bars_top - 4}, {x, bottom}, "grid");
    drawing.text({x, bottom + 14}, fmt::format("{} %", percent), "middle small");
  }
}

void draw_bars_legend(SvgDrawing& drawing, const Columns& columns,
                      const std::vector<std::string>& kinds, double y) {
  for (std::size_t kind = 0; kind < kinds.size(); ++kind, y += bars_legend_step) {
    drawing.rectangle({columns.left, y - bars_patch}, bars_patch, bars_patch, styles[kind]);
    drawing.text({columns.left + bars_patch + 6, y}, kinds[kind], "");
  }
}

}  // namespace

void add_counts(ShareBars& bars, const std::string& label,
                const std::vector<std::uint64_t>& counts) {
  auto row = std::ranges::find(bars.rows, label, &ShareRow::label);
  if (row == bars.rows.end()) row = bars.rows.insert(row, {label, {}});
  row->counts.resize(std::max(row->counts.size(), counts.size()));
  std::ranges::transform(counts, row->counts, row->counts.begin(), std::plus<>());
}

std::string share_bars_as_svg(const ShareBars& bars) {
  const double bottom = bottom_of(bars);
  const double height = bottom + 30 + bars_legend_step * static_cast<double>(bars.kinds.size());
  const Columns columns(bars);
  SvgDrawing drawing(columns.right() + bars_margin, height, bars.title, bars.description);
  drawing.text({bars_margin, 20}, bars.title, "heading");
  drawing.text({bars_margin, bars_top - 10}, bars.rows_label, "small");
  draw_scale(drawing, columns, bottom);
  double y = bars_top;
  for (const ShareRow& row : bars.rows) {
    draw_row(drawing, columns, row, y);
    y += row_step;
  }
  draw_bars_legend(drawing, columns, bars.kinds, bottom + 36);
  return drawing.finished();
}

}  // namespace sim
