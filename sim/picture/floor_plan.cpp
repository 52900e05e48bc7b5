#include "sim/picture/floor_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "sim/picture/scale.hpp"
#include "sim/picture/svg.hpp"

namespace sim {
namespace {

// Pixels.
constexpr double plan_width = 720, plan_left = 60, plan_top = 40, widest = 640, tallest = 560;
constexpr double plan_margin = 26;  // around what is shown, for its labels
constexpr double plan_legend_step = 16;
constexpr double disc = 3, tip = 17, mark_corner = 8, dot = 1.2, track = 5;

/// The class of a mark, with another behind it.
std::string style_of(const PlanMark& mark, const std::string& other) {
  return mark.colour ? curve_style(*mark.colour) + " " + other : other;
}

bool is_somewhere(PlanPoint p) { return std::isfinite(p.x_m) && std::isfinite(p.y_m); }

/// The rectangle that covers points.
struct Extent {
  double x_least = std::numeric_limits<double>::infinity(), x_greatest = -x_least;
  double y_least = x_least, y_greatest = -x_least;

  void cover(PlanPoint p) {
    if (!is_somewhere(p)) return;
    x_least = std::min(x_least, p.x_m), x_greatest = std::max(x_greatest, p.x_m);
    y_least = std::min(y_least, p.y_m), y_greatest = std::max(y_greatest, p.y_m);
  }
  double size() const { return std::max(x_greatest - x_least, y_greatest - y_least); }
  /// Nothing, or a single point, has some floor too.
  void widen() {
    if (!(x_least <= x_greatest)) cover({0, 0});
    const double least = std::max(size() / 8, 0.05);
    x_least -= std::max(0.0, (least - (x_greatest - x_least)) / 2);
    x_greatest = std::max(x_greatest, x_least + least);
    y_least -= std::max(0.0, (least - (y_greatest - y_least)) / 2);
    y_greatest = std::max(y_greatest, y_least + least);
  }
};

/// A point of an ellipse, by the angle from its longer half axis.
PlanPoint on_ellipse(const PlanEllipse& e, double angle) {
  const double u = e.semi_major_m * std::cos(angle), v = e.semi_minor_m * std::sin(angle);
  const double c = std::cos(e.direction), s = std::sin(e.direction);
  return {e.centre.x_m + c * u - s * v, e.centre.y_m + s * u + c * v};
}

constexpr int ellipse_steps = 72;
double ellipse_angle(int step) { return 2 * M_PI * step / ellipse_steps; }

Extent extent_without_ellipses(const FloorPlan& plan) {
  Extent extent;
  for (const PlanPoint& p : plan.way) extent.cover(p);
  for (const auto* marks : {&plan.devices, &plan.receivers})
    for (const PlanMark& mark : *marks) extent.cover(mark.at);
  for (const PlanDots& kind : plan.dots)
    for (const PlanDots::Dot& each : kind.dots) extent.cover(each.at);
  return extent;
}

/// From metres to pixels, the same along both.
class Ground {
 public:
  Ground(const FloorPlan& plan, const std::vector<PlanEllipse>& ellipses)
      : extent_(extent_without_ellipses(plan)) {
    for (const PlanEllipse& e : ellipses)
      for (int step = 0; step < ellipse_steps; ++step)
        extent_.cover(on_ellipse(e, ellipse_angle(step)));
    extent_.widen();
    const double across = extent_.x_greatest - extent_.x_least;
    const double up = extent_.y_greatest - extent_.y_least;
    pixels_ = std::min((widest - 2 * plan_margin) / across, (tallest - 2 * plan_margin) / up);
    right_ = plan_left + 2 * plan_margin + pixels_ * across;
    bottom_ = plan_top + 2 * plan_margin + pixels_ * up;
  }

  double right() const { return right_; }
  double bottom() const { return bottom_; }
  SvgPoint operator()(PlanPoint p) const {
    return {plan_left + plan_margin + pixels_ * (p.x_m - extent_.x_least),
            bottom_ - plan_margin - pixels_ * (p.y_m - extent_.y_least)};
  }
  /// Round metres within the picture, as far apart along both axes.
  std::vector<double> marks_across() const { return marks(plan_left, right_, extent_.x_least); }
  std::vector<double> marks_up() const { return marks(plan_top, bottom_, extent_.y_least); }

 private:
  std::vector<double> marks(double from, double to, double least) const {
    const double first = least - plan_margin / pixels_, last = first + (to - from) / pixels_;
    const std::vector<double> apart =
        round_values(0, std::max(right_ - plan_left, bottom_ - plan_top) / pixels_, 9);
    const double step = apart.size() > 1 ? apart[1] - apart[0] : last - first;
    std::vector<double> values;
    for (double i = std::ceil(first / step); i * step <= last; ++i)
      values.push_back(i * step + 0.0);  // no -0
    return values;
  }

  Extent extent_;
  double pixels_, right_, bottom_;
};

void draw_ground(SvgDrawing& drawing, const Ground& ground) {
  drawing.rectangle({plan_left, plan_top}, ground.right() - plan_left, ground.bottom() - plan_top,
                    "floor");
  for (const double x : ground.marks_across()) {
    const double at = ground({x, 0}).x;
    drawing.line({at, plan_top}, {at, ground.bottom()}, "grid");
    drawing.text({at, ground.bottom() + 16}, fmt::format("{:g}", x), "middle small");
  }
  for (const double y : ground.marks_up()) {
    const double at = ground({0, y}).y;
    drawing.line({plan_left, at}, {ground.right(), at}, "grid");
    drawing.text({plan_left - 8, at + 4}, fmt::format("{:g}", y), "end small");
  }
  drawing.text({(plan_left + ground.right()) / 2, ground.bottom() + 34}, "x [m]", "middle");
  drawing.text({8, plan_top - 8}, "y [m]", "");
}

std::string move_to(SvgPoint p) { return fmt::format("M{:.2f} {:.2f}", p.x, p.y); }
std::string line_to(SvgPoint p) { return fmt::format("L{:.2f} {:.2f}", p.x, p.y); }

std::string circle(SvgPoint centre, double radius) {
  return fmt::format("M{0:.2f} {1:.2f}a{2} {2} 0 1 0 {3} 0a{2} {2} 0 1 0 -{3} 0Z",
                     centre.x - radius, centre.y, radius, 2 * radius);
}

/// So many pixels from a place, at an angle from where a heading goes.
SvgPoint beside(SvgPoint p, double heading, double pixels) {
  return {p.x + pixels * std::cos(heading), p.y - pixels * std::sin(heading)};
}

void draw_way(SvgDrawing& drawing, const FloorPlan& plan, const Ground& ground) {
  std::string path;
  for (const PlanPoint& p : plan.way)
    path += path.empty() ? move_to(ground(p)) : line_to(ground(p));
  drawing.path(path, "way");
}

void draw_label(SvgDrawing& drawing, const PlanMark& mark, const Ground& ground) {
  const SvgPoint at = ground(mark.at);
  const bool is_right = at.x > (plan_left + ground.right()) / 2;
  drawing.text({at.x + (is_right ? -12 : 12), at.y - 9}, mark.label, is_right ? "end" : "");
}

void draw_device(SvgDrawing& drawing, const PlanMark& mark, const Ground& ground) {
  if (!is_somewhere(mark.at)) return;
  const SvgPoint at = ground(mark.at);
  if (mark.heading)
    drawing.path(move_to(at) + line_to(beside(at, *mark.heading, tip)), style_of(mark, "dot"));
  drawing.path(circle(at, mark.is_solid ? disc : 2 * disc - 1),
               style_of(mark, mark.is_solid ? "disc" : "dot"));
  draw_label(drawing, mark, ground);
}

void draw_receiver(SvgDrawing& drawing, const PlanMark& mark, const Ground& ground) {
  if (!is_somewhere(mark.at)) return;
  const SvgPoint at = ground(mark.at);
  const double heading = mark.heading.value_or(M_PI / 2);
  drawing.path(move_to(beside(at, heading, 1.5 * mark_corner)) +
                   line_to(beside(at, heading + 2.4, mark_corner)) +
                   line_to(beside(at, heading - 2.4, mark_corner)) + "Z",
               "dot");
  draw_label(drawing, mark, ground);
}

/// Places that look the same are drawn once.
void draw_dots(SvgDrawing& drawing, const FloorPlan& plan, const Ground& ground) {
  for (std::size_t kind = 0; kind < plan.dots.size(); ++kind) {
    const double from_middle =
        static_cast<double>(plan.dots.size() - 1) / 2 - static_cast<double>(kind);
    const double side = plan.dots[kind].is_in_place ? 0 : track * from_middle;
    std::set<std::pair<long, long>> drawn;
    std::string path;
    for (const PlanDots::Dot& each : plan.dots[kind].dots) {
      if (!is_somewhere(each.at) || !std::isfinite(each.heading)) continue;
      const SvgPoint at = beside(ground(each.at), each.heading + M_PI / 2, side);
      if (drawn.emplace(std::lround(at.x), std::lround(at.y)).second) path += circle(at, dot);
    }
    drawing.path(path, curve_style(plan.dots[kind].colour) + " dot");
  }
}

void draw_ellipse(SvgDrawing& drawing, const PlanEllipse& ellipse, const Ground& ground) {
  std::string path;
  for (int step = 0; step < ellipse_steps; ++step) {
    const SvgPoint at = ground(on_ellipse(ellipse, ellipse_angle(step)));
    path += step == 0 ? move_to(at) : line_to(at);
  }
  drawing.path(path + "Z", curve_style(ellipse.colour));
}

void draw_plan_legend(SvgDrawing& drawing, const FloorPlan& plan, double y) {
  for (const PlanDots& kind : plan.dots) {
    const std::string colour = curve_style(kind.colour);
    drawing.path(circle({plan_left + 6, y - 4}, dot), colour + " dot");
    if (kind.is_in_place) drawing.path(circle({plan_left + 6, y - 4}, 2 * disc), colour);
    drawing.text({plan_left + 20, y}, kind.label, "");
    y += plan_legend_step;
  }
}

}  // namespace

std::vector<PlanEllipse> drawn_ellipses(const FloorPlan& plan) {
  Extent extent = extent_without_ellipses(plan);
  extent.widen();
  std::vector<PlanEllipse> drawn;
  for (const PlanEllipse& e : plan.ellipses)
    if (e.semi_major_m <= extent.size() && is_somewhere(on_ellipse(e, 1))) drawn.push_back(e);
  return drawn;
}

std::string floor_plan_as_svg(const FloorPlan& plan) {
  const std::vector<PlanEllipse> ellipses = drawn_ellipses(plan);
  const Ground ground(plan, ellipses);
  const double legend = ground.bottom() + 56;
  SvgDrawing drawing(plan_width, legend + plan_legend_step * static_cast<double>(plan.dots.size()),
                     plan.title, plan.description);
  drawing.text({8, 18}, plan.title, "heading");
  draw_ground(drawing, ground);
  draw_way(drawing, plan, ground);
  draw_dots(drawing, plan, ground);
  for (const PlanEllipse& e : ellipses) draw_ellipse(drawing, e, ground);
  for (const PlanMark& mark : plan.receivers) draw_receiver(drawing, mark, ground);
  for (const PlanMark& mark : plan.devices) draw_device(drawing, mark, ground);
  draw_plan_legend(drawing, plan, legend);
  return drawing.finished();
}

}  // namespace sim
