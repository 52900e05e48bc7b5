#include "sim/picture/path_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

namespace sim {
namespace {

constexpr double most_off = 0.02;  // pixels that a line is away from its arc

struct Arc {
  SvgPoint from, to{};
  double rx = 0, ry = 0, tilt = 0;  // tilt in radians, from x to y
  bool is_large = false, is_clockwise = false;
};

/// An ellipse's own axes: the circle of radius 1 about 0.
SvgPoint onto_circle(SvgPoint p, const Arc& arc) {
  return {(std::cos(arc.tilt) * p.x + std::sin(arc.tilt) * p.y) / arc.rx,
          (std::cos(arc.tilt) * p.y - std::sin(arc.tilt) * p.x) / arc.ry};
}

SvgPoint from_circle(SvgPoint p, const Arc& arc) {
  const double x = p.x * arc.rx, y = p.y * arc.ry;
  return {std::cos(arc.tilt) * x - std::sin(arc.tilt) * y,
          std::sin(arc.tilt) * x + std::cos(arc.tilt) * y};
}

/// On the circle of radius 1: its centre is on the line that halves the one between both ends.
SvgPoint centre_of(SvgPoint from, SvgPoint to, const Arc& arc) {
  const SvgPoint half{(to.x - from.x) / 2, (to.y - from.y) / 2};
  const double squared = half.x * half.x + half.y * half.y;
  const double away =
      std::sqrt(std::max(0.0, 1 / squared - 1)) * (arc.is_large == arc.is_clockwise ? 1 : -1);
  return {from.x + half.x + away * half.y, from.y + half.y - away * half.x};
}

/// How far it goes round, from one place of the circle to another; positive from x to y.
double turn_of(SvgPoint from, SvgPoint to, SvgPoint centre, bool is_clockwise) {
  const double turn = std::atan2(to.y - centre.y, to.x - centre.x) -
                      std::atan2(from.y - centre.y, from.x - centre.x);
  if (is_clockwise) return turn < 0 ? turn + 2 * std::numbers::pi : turn;
  return turn > 0 ? turn - 2 * std::numbers::pi : turn;
}

/// One that is too small to reach both ends is made as large as it must be.
void stretch(Arc& arc) {
  const SvgPoint from = onto_circle(arc.from, arc), to = onto_circle(arc.to, arc);
  const double least = std::max(1.0, std::hypot(to.x - from.x, to.y - from.y) / 2);
  arc.rx *= least;
  arc.ry *= least;
}

/// Without its beginning.
Polyline points_of(Arc arc) {
  if (arc.rx == 0 || arc.ry == 0 || (arc.from.x == arc.to.x && arc.from.y == arc.to.y))
    return {arc.to};
  stretch(arc);
  const SvgPoint from = onto_circle(arc.from, arc), to = onto_circle(arc.to, arc);
  const SvgPoint centre = centre_of(from, to, arc);
  const double begin = std::atan2(from.y - centre.y, from.x - centre.x);
  const double turn = turn_of(from, to, centre, arc.is_clockwise);
  const double step = 2 * std::acos(1 - most_off / std::max({arc.rx, arc.ry, 1.0}));
  const double steps = std::ceil(std::abs(turn) / step);
  Polyline points;
  for (int i = 1; i < steps; ++i) {
    const double angle = begin + turn * i / steps;
    points.push_back(from_circle({centre.x + std::cos(angle), centre.y + std::sin(angle)}, arc));
  }
  points.push_back(arc.to);
  return points;
}

class PathReader {
 public:
  explicit PathReader(std::string_view data) : rest_(data) {}

  std::vector<Polyline> all() {
    while (skip_blanks()) {
      take_command();
      draw();
    }
    end_line();
    return std::move(lines_);
  }

 private:
  [[noreturn]] void refuse() const {
    throw std::logic_error("a drawing's path has \"" + std::string(rest_.substr(0, 20)) + "\"");
  }
  bool skip_blanks() {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(" ,\n\t"), rest_.size()));
    return !rest_.empty();
  }
  /// One that is not named is the one before; a line behind a move.
  void take_command() {
    if (std::isalpha(static_cast<unsigned char>(rest_.front())) != 0) {
      command_ = rest_.front();
      rest_.remove_prefix(1);
    } else if (command_ == 'M' || command_ == 'm') {
      command_ = command_ == 'M' ? 'L' : 'l';
    } else if (command_ == 'Z' || command_ == 'z') {
      refuse();
    }
  }
  double number() {
    skip_blanks();
    double value = 0;
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    if (error != std::errc() || !std::isfinite(value)) refuse();
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    return value;
  }

  bool is_relative() const { return std::islower(static_cast<unsigned char>(command_)) != 0; }
  double x() { return number() + (is_relative() ? at_.x : 0); }
  double y() { return number() + (is_relative() ? at_.y : 0); }
  SvgPoint point() {
    const double across = x();
    return {across, y()};
  }

  void draw() {
    switch (command_) {
      case 'M':
      case 'm':
        return move_to(point());
      case 'L':
      case 'l':
        return line_to(point());
      case 'H':
      case 'h':
        return line_to({x(), at_.y});
      case 'V':
      case 'v':
        return line_to({at_.x, y()});
      case 'A':
      case 'a':
        return draw_arc();
      case 'Z':
      case 'z':
        line_to(start_);
        return move_to(start_);
      default:
        refuse();
    }
  }
  void draw_arc() {
    Arc arc{.from = at_};
    arc.rx = std::abs(number());
    arc.ry = std::abs(number());
    arc.tilt = number() * std::numbers::pi / 180;
    arc.is_large = number() != 0;
    arc.is_clockwise = number() != 0;
    arc.to = point();
    for (const SvgPoint& next : points_of(arc)) line_to(next);
  }
  void move_to(SvgPoint to) {
    end_line();
    line_ = {to};
    start_ = at_ = to;
  }
  void line_to(SvgPoint to) {
    line_.push_back(to);
    at_ = to;
  }
  void end_line() {
    if (line_.size() > 1) lines_.push_back(std::move(line_));
  }

  std::string_view rest_;
  char command_ = ' ';
  SvgPoint at_, start_;
  Polyline line_;
  std::vector<Polyline> lines_;
};

}  // namespace

std::string path_through(const Polyline& corners) {
  std::string data;
  for (const SvgPoint& corner : corners)
    data += fmt::format("{}{:.1f} {:.1f}", data.empty() ? "M" : "L", corner.x, corner.y);
  return data;
}

std::vector<Polyline> polylines_of(std::string_view data) { return PathReader(data).all(); }

}  // namespace sim
