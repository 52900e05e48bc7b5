#include "sim/picture/curve_labels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace sim {
namespace {

// Pixels.
constexpr double words_beside = 7, words_above = 4,
                 words_below = 15;  // of the words, from the line
constexpr double character = 6.6, tall = 11, clear = 2;

SvgPoint between(const PaperLine& line, double along) {
  return {std::lerp(line.from.x, line.to.x, along), std::lerp(line.from.y, line.to.y, along)};
}

double distance(const PaperLine& line, const SvgPoint& point) {
  const double wide = line.to.x - line.from.x, high = line.to.y - line.from.y;
  const double squared = wide * wide + high * high;
  const double ahead = (point.x - line.from.x) * wide + (point.y - line.from.y) * high;
  const SvgPoint nearest = between(line, squared > 0 ? std::clamp(ahead / squared, 0.0, 1.0) : 0.0);
  return std::hypot(point.x - nearest.x, point.y - nearest.y);
}

/// Of the way along a line: what lies between two values of one coordinate.
struct Within {
  double from = 0, to = 1;

  void take(double begin, double end, double low, double high) {
    if (begin == end) {
      if (begin < low || begin > high) to = -1;
      return;
    }
    const double one = (low - begin) / (end - begin), other = (high - begin) / (end - begin);
    from = std::max(from, std::min(one, other));
    to = std::min(to, std::max(one, other));
  }
};

bool crosses(const PaperLine& line, const PaperBox& box) {
  Within within;
  within.take(line.from.x, line.to.x, box.left, box.right);
  within.take(line.from.y, line.to.y, box.top, box.bottom);
  return within.from <= within.to;
}

bool overlap(const PaperBox& one, const PaperBox& other) {
  return one.left < other.right && other.left < one.right && one.top < other.bottom &&
         other.top < one.bottom;
}

bool is_within(const PaperBox& box, const PaperBox& paper) {
  return box.left >= paper.left && box.right <= paper.right && box.top >= paper.top &&
         box.bottom <= paper.bottom;
}

std::vector<PaperLine> paper_lines_of(const LaidCurve& curve) {
  std::vector<PaperLine> lines;
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    if (!curve.points[i]) continue;
    const bool goes_on = i + 1 < curve.points.size() && curve.points[i + 1];
    lines.push_back({*curve.points[i], *curve.points[goes_on ? i + 1 : i]});
  }
  return lines;
}

double distance(const std::vector<PaperLine>& lines, const SvgPoint& point) {
  double least = std::numeric_limits<double>::infinity();
  for (const PaperLine& line : lines) least = std::min(least, distance(line, point));
  return least;
}

class LabelPlaces {
 public:
  LabelPlaces(const std::vector<LaidCurve>& curves, const PaperBox& paper)
      : curves_(curves), paper_(paper) {
    for (const LaidCurve& curve : curves) lines_.push_back(paper_lines_of(curve));
  }

  std::vector<CurveLabel> operator()() {
    std::vector<CurveLabel> labels;
    for (std::size_t i = 0; i < curves_.size(); ++i) {
      if (curves_[i].name.empty()) continue;
      const std::optional<CurveLabel> best = best_of(i);
      if (!best) continue;
      labels.push_back(*best);
      taken_.push_back(box_of(*best));
    }
    return labels;
  }

 private:
  /// Those that are tried, all along the curve.
  std::vector<CurveLabel> places_along(std::size_t curve) const {
    constexpr std::size_t most_points = 64;
    const auto& points = curves_[curve].points;
    std::vector<CurveLabel> places;
    for (std::size_t i = 0; i < points.size(); i += 1 + points.size() / most_points) {
      if (!points[i]) continue;
      const bool goes_on = i + 1 < points.size() && points[i + 1];
      for (const double along : {0.0, 0.25, 0.5, 0.75}) {
        if (along > 0 && !goes_on) break;
        for (const auto& [is_left, is_above] : {std::pair{false, true}, std::pair{false, false},
                                                std::pair{true, true}, std::pair{true, false}})
          places.push_back({curve, i, along, is_left, is_above});
      }
    }
    return places;
  }

  /// The clearest place.
  std::optional<CurveLabel> best_of(std::size_t curve) const {
    std::optional<CurveLabel> best;
    double clearest = 0;
    for (const CurveLabel& label : places_along(curve)) {
      const double clearance = clearance_of(label);
      if (clearance <= clearest) continue;
      clearest = clearance;
      best = label;
    }
    return best;
  }

  PaperBox box_of(const CurveLabel& label) const {
    const LaidCurve& curve = curves_[label.curve];
    const SvgPoint at = anchor_of(label, curve);
    const double wide = character * static_cast<double>(curve.name.size());
    const double left = label.is_left ? at.x - wide : at.x;
    return {left - clear, at.y - tall - clear, left + wide + clear, at.y + clear};
  }

  /// By how much nearer it is to its own curve than to all others; 0 or less where it must not be.
  double clearance_of(const CurveLabel& label) const {
    constexpr double enough = 40;
    const PaperBox box = box_of(label);
    if (!is_within(box, paper_)) return 0;
    if (std::ranges::any_of(taken_, [&](const PaperBox& other) { return overlap(box, other); }))
      return 0;
    const SvgPoint middle{(box.left + box.right) / 2, (box.top + box.bottom) / 2};
    const auto is_crossed = [&](const PaperLine& line) { return crosses(line, box); };
    double others = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      if (std::ranges::any_of(lines_[i], is_crossed)) return 0;
      if (std::ranges::any_of(curves_[i].intervals, is_crossed)) return 0;
      if (i != label.curve && !curves_[i].is_theory)
        others = std::min(others, distance(lines_[i], middle));
    }
    return std::min(others - distance(lines_[label.curve], middle), enough);
  }

  const std::vector<LaidCurve>& curves_;
  PaperBox paper_;
  std::vector<std::vector<PaperLine>> lines_;
  std::vector<PaperBox> taken_;
};

}  // namespace

SvgPoint anchor_of(const CurveLabel& label, const LaidCurve& curve) {
  const SvgPoint from = *curve.points[label.point];
  const SvgPoint to = label.along > 0 ? *curve.points[label.point + 1] : from;
  const SvgPoint at = between({from, to}, label.along);
  return {at.x + (label.is_left ? -words_beside : words_beside),
          at.y + (label.is_above ? -words_above : words_below)};
}

std::vector<CurveLabel> curve_labels(const std::vector<LaidCurve>& curves, const PaperBox& paper) {
  return LabelPlaces(curves, paper)();
}

}  // namespace sim
