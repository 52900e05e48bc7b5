#include "sim/check/baseline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "sim/failure.hpp"
#include "sim/loading/load_scenario.hpp"
#include "sim/text/digest.hpp"

namespace sim {
namespace {

/// The first line of one that the other does not have at its place.
std::string first_difference(const std::string& here, const std::string& there) {
  std::istringstream a(here), b(there);
  for (std::string line, other; std::getline(a, line);)
    if (!std::getline(b, other) || line != other) return fmt::format("{}, there {}", line, other);
  return "";
}

/// What differs between a point and the scenario that the baseline carries.
std::string difference(const Baseline& baseline, const BaselinePoint& old,
                       const JudgedPoint& point) {
  const std::string& text = baseline.scenarios.at(old.scenario);
  for (const JudgedPoint& stored : judged_points(parse_scenario(text, point.file, {}, {})))
    if (stored.name == point.name) return first_difference(point.physics, stored.physics);
  return "";
}

}  // namespace

std::uint64_t physics_hash(const JudgedPoint& point) { return hash_of(point.physics); }

const BaselinePoint& counterpart(const Baseline& baseline, const JudgedPoint& point,
                                 const std::filesystem::path& file) {
  const auto old = std::ranges::find(baseline.points, point.name, &BaselinePoint::name);
  if (old == baseline.points.end())
    throw bad_input(point.name, "the baseline " + file.string() + " has no such point",
                    "make it anew with cosys-sim baseline");
  if (old->physics == physics_hash(point)) return *old;
  const std::string what = difference(baseline, *old, point);
  throw bad_input(point.name,
                  "the baseline " + file.string() + " is of another scenario" +
                      (what.empty() ? "" : ": here " + what),
                  "give the one that it was made of, or make it anew with cosys-sim baseline");
}

}  // namespace sim
