#pragma once
// A floor from above, to scale: who stands where and looks where, a way over it, what happened
// where, and ellipses of errors. Lengths are metres, y goes up, angles are radians from +x.
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace sim {

struct PlanPoint {
  double x_m = 0, y_m = 0;
};

struct PlanMark {
  PlanPoint at;
  std::string label{};  // empty: none is written
  std::optional<double> heading{};
  std::optional<std::size_t> colour = 0;  // of those of curves; nothing: that of texts
  bool is_solid = true;
};

/// Dots of a kind, on a track of its own beside the way, or, together with an ellipse of that
/// colour, where they are.
struct PlanDots {
  struct Dot {
    PlanPoint at;
    double heading = 0;
  };
  std::string label;
  std::vector<Dot> dots;
  std::size_t colour = 0;
  bool is_in_place = false;
};

struct PlanEllipse {
  PlanPoint centre;
  double semi_major_m = 0, semi_minor_m = 0;
  double direction = 0;  // of the longer half axis
  std::size_t colour = 0;
};

struct FloorPlan {
  std::string title, description;
  std::vector<PlanPoint> way{};
  std::vector<PlanMark> devices{};    // round
  std::vector<PlanMark> receivers{};  // three-cornered
  std::vector<PlanDots> dots{};
  std::vector<PlanEllipse> ellipses{};
};

/// Those that have a place on the picture: not of more than twice the size of the rest.
std::vector<PlanEllipse> drawn_ellipses(const FloorPlan& plan);

/// As SVG. The floor is as large as all of it, but for ellipses that are left out.
std::string floor_plan_as_svg(const FloorPlan& plan);

}  // namespace sim
