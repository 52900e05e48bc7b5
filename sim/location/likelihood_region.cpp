#include "sim/location/likelihood_region.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace sim {
namespace {

constexpr int outline_points = 72;

/// Places around one in its deviations: steps of equal length are about equally likely.
class Deviations {
 public:
  Deviations(const Position& origin, const PositionCovariance& c)
      : origin_(origin),
        x_(std::sqrt(c.xx)),
        slant_(c.xy / x_),
        y_(std::sqrt(c.yy - slant_ * slant_)) {}

  Position at(double u, double v) const {
    return {origin_.x + x_ * u, origin_.y + slant_ * u + y_ * v};
  }

 private:
  Position origin_;
  double x_, slant_, y_;  // Cholesky's root of the covariance
};

/// Where one leaves the region that way by steps that grow, then halved: for the first time, or
/// if it is all of one place, and so bent where it is left and entered again, for the last.
double reach(const Likelihood& likelihood, const Deviations& around, double direction, double limit,
             bool is_alone) {
  constexpr double first = 0.3, growth = 1.25;
  constexpr int halvings = 14;
  const auto at = [&](double r) {
    return likelihood(around.at(r * std::cos(direction), r * std::sin(direction)));
  };
  const auto is_inside = [&](double r) { return at(r) <= limit; };
  double inside = 0;
  for (double r = first; is_alone ? std::isfinite(at(r)) : is_inside(r); r *= growth)
    if (is_inside(r)) inside = r;
  double outside = inside > 0 ? inside * growth : first;
  for (int i = 0; i < halvings; ++i) {
    const double middle = (inside + outside) / 2;
    (is_inside(middle) ? inside : outside) = middle;
  }
  return inside;
}

/// Integrals over a polygon of 1, x, y, x^2, xy and y^2, by triangles from its first corner, from
/// which x and y count.
struct PolygonMoments {
  explicit PolygonMoments(const std::vector<Position>& corners) {
    const Position& first = corners.front();
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
      add({corners[i].x - first.x, corners[i].y - first.y},
          {corners[i + 1].x - first.x, corners[i + 1].y - first.y});
  }

  void add(const Position& a, const Position& b) {
    const double twice = a.x * b.y - b.x * a.y;
    area += twice / 2;
    x += twice * (a.x + b.x) / 6;
    y += twice * (a.y + b.y) / 6;
    xx += twice * (a.x * a.x + a.x * b.x + b.x * b.x) / 12;
    yy += twice * (a.y * a.y + a.y * b.y + b.y * b.y) / 12;
    xy += twice * (2 * a.x * a.y + a.x * b.y + b.x * a.y + 2 * b.x * b.y) / 24;
  }

  double area = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
};

/// An ellipse of half axes a and b has the moments a^2 / 4 and b^2 / 4 of its area.
ErrorEllipse ellipse_of(const PolygonMoments& m) {
  constexpr double unit = 4 / chi_square_95;
  const double x = m.x / m.area, y = m.y / m.area;
  return error_ellipse({unit * (m.xx / m.area - x * x), unit * (m.xy / m.area - x * y),
                        unit * (m.yy / m.area - y * y)});
}

/// Half of how far the places lie apart, seen along a direction.
double half_length(const std::vector<Position>& places, dsp::Radians direction) {
  const double x = std::cos(direction.value), y = std::sin(direction.value);
  double first = std::numeric_limits<double>::infinity(), last = -first;
  for (const Position& place : places) {
    const double along = x * place.x + y * place.y;
    first = std::min(first, along);
    last = std::max(last, along);
  }
  return (last - first) / 2;
}

}  // namespace

std::optional<LikelihoodRegion> likelihood_region(const Likelihood& likelihood,
                                                  const Position& best,
                                                  const PositionCovariance& scale, double limit,
                                                  bool is_alone) {
  if (!(likelihood(best) < limit)) return std::nullopt;
  const Deviations around(best, scale);
  LikelihoodRegion region;
  for (int i = 0; i < outline_points; ++i) {
    const double direction = 2 * std::numbers::pi * i / outline_points;
    const double r = reach(likelihood, around, direction, limit, is_alone);
    region.outline.push_back(around.at(r * std::cos(direction), r * std::sin(direction)));
  }
  const PolygonMoments moments(region.outline);
  const Position& first = region.outline.front();
  region.centre = {first.x + moments.x / moments.area, first.y + moments.y / moments.area};
  ErrorEllipse& ellipse = region.ellipse = ellipse_of(moments);
  const dsp::Radians across = ellipse.direction + dsp::Radians(std::numbers::pi / 2);
  ellipse.semi_major_m =
      std::max(ellipse.semi_major_m, half_length(region.outline, ellipse.direction));
  ellipse.semi_minor_m = std::max(ellipse.semi_minor_m, half_length(region.outline, across));
  return region;
}

/// By steps along two axes, halved where none makes it more likely.
Position most_likely(const Likelihood& likelihood, const Position& start,
                     const PositionCovariance& scale) {
  constexpr double first = 0.5, last = 1e-3;  // of a deviation
  constexpr std::array<Position, 4> ways{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
  Position best = start;
  double least = likelihood(best);
  for (double step = first; step > last;) {
    const Deviations around(best, scale);
    bool moved = false;
    for (const Position& way : ways) {
      const Position next = around.at(step * way.x, step * way.y);
      const double there = likelihood(next);
      if (!(there < least)) continue;
      best = next;
      least = there;
      moved = true;
    }
    if (!moved) step /= 2;
  }
  return best;
}

}  // namespace sim
