#include "sim/arena/trajectory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "sim/text/number_text.hpp"

namespace sim {
namespace {

using dsp::Radians;
using dsp::Seconds;

/// The shorter way round, -pi to pi.
Radians turned(Radians from, Radians to) {
  return Radians(std::remainder(to.value - from.value, 2 * std::numbers::pi));
}

double distance_between(const Pose2D& a, const Pose2D& b) {
  return std::hypot(b.x - a.x, b.y - a.y);
}

std::vector<double> numbers_of(const char* key, const std::string& list) {
  if (list.empty()) return {};
  return parse_values(list, fmt::format("path.{} = {}", key, list));
}

std::vector<double> at_each(const char* key, std::vector<double> list, std::size_t points) {
  return stretched(std::move(list), points, fmt::format("path.{}", key),
                   fmt::format("the way has {} way-points", points));
}

double share_of_way(Seconds start, Seconds end, Seconds t) {
  return end > start ? std::clamp((t - start) / (end - start), 0.0, 1.0) : 1.0;
}

}  // namespace

Trajectory::Trajectory(const PathSettings& path) {
  auto x = numbers_of("x_m", path.x_m), y = numbers_of("y_m", path.y_m);
  const auto headings = numbers_of("heading_deg", path.heading_deg);
  const std::size_t points = std::max({x.size(), y.size(), headings.size(), std::size_t{1}});
  x = at_each("x_m", x, points);
  y = at_each("y_m", y, points);
  now_ = {x[0], y[0], Radians(0)};
  if (headings.empty()) {
    for (std::size_t i = 1; i < points; ++i) {
      const Radians heading(std::atan2(y[i] - now_.y, x[i] - now_.x));
      if (distance_between(now_, {x[i], y[i], {}}) == 0) continue;
      if (legs_.empty()) now_.heading = heading;
      turn(heading, dsp::degrees(path.turn_deg_per_s));
      go({x[i], y[i], now_.heading}, path.speed_m_per_s);
    }
    return;
  }
  const auto looks = at_each("heading_deg", headings, points);
  now_.heading = dsp::degrees(looks[0]);
  for (std::size_t i = 1; i < points; ++i) {
    const Radians by = turned(now_.heading, dsp::degrees(looks[i]));
    const Pose2D next{x[i], y[i], now_.heading + by};
    if (distance_between(now_, next) == 0)
      turn(next.heading, dsp::degrees(path.turn_deg_per_s));
    else
      go(next, path.speed_m_per_s);
  }
}

void Trajectory::go(const Pose2D& to, double speed_m_per_s) {
  add(to, Seconds(distance_between(now_, to) / speed_m_per_s));
}

void Trajectory::turn(Radians heading, Radians per_second) {
  const Radians by = turned(now_.heading, heading);
  if (by.value == 0) return;
  add({now_.x, now_.y, now_.heading + by}, Seconds(std::abs(by / per_second)));
}

void Trajectory::add(const Pose2D& to, Seconds time) {
  const Seconds start = duration();
  const double before =
      legs_.empty() ? 0 : legs_.back().distance_before + distance_between(legs_.back().from, now_);
  legs_.push_back({start, start + time, now_, to, before});
  now_ = to;
}

const Trajectory::Leg* Trajectory::leg_at(Seconds t) const {
  if (legs_.empty()) return nullptr;
  const auto next = std::ranges::upper_bound(legs_, t, {}, &Leg::start);
  return next == legs_.begin() ? &legs_.front() : &*(next - 1);
}

Pose2D Trajectory::at(Seconds t) const {
  const Leg* leg = leg_at(t);
  if (leg == nullptr) return now_;
  const double share = share_of_way(leg->start, leg->end, t);
  const auto between = [&](double a, double b) { return a + share * (b - a); };
  return {between(leg->from.x, leg->to.x), between(leg->from.y, leg->to.y),
          Radians(between(leg->from.heading.value, leg->to.heading.value))};
}

std::vector<Pose2D> Trajectory::corners() const {
  if (legs_.empty()) return {now_};
  std::vector<Pose2D> corners{legs_.front().from};
  for (const Leg& leg : legs_) corners.push_back(leg.to);
  return corners;
}

double Trajectory::distance(Seconds t) const {
  const Leg* leg = leg_at(t);
  if (leg == nullptr) return 0;
  return leg->distance_before +
         share_of_way(leg->start, leg->end, t) * distance_between(leg->from, leg->to);
}

}  // namespace sim
