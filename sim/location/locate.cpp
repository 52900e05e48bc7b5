#include "sim/location/locate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <limits>

#include "sim/failure.hpp"

namespace sim {
namespace {

/// Scattered light is linear so far around a place, as a share of the distance to the nearest
/// receiver: it falls as 1/d^3, so a hundredth of the light is off by 3 parts in 10 000 of itself;
/// prepared once for all, by 6 in 1000.
constexpr double linear_share = 0.01, prepared_share = 0.05;
constexpr int most_polishes = 8;

/// Slopes are differences: what is finer drowns in their rounding.
constexpr double least_relative_deviation = 1e-7;

std::string in_words(std::size_t i) { return fmt::format("reading {}", i + 1); }

void check(const Reading& r, std::size_t i) {
  if (!std::isfinite(r.irradiance_w_per_m2))
    throw bad_input(fmt::format("{} of {} W/m2", in_words(i), r.irradiance_w_per_m2),
                    "light is a number", "leave failures out");
  if (!(std::isfinite(r.deviation_w_per_m2) && r.deviation_w_per_m2 > 0))
    throw bad_input(fmt::format("{} has a deviation of {} W/m2", in_words(i), r.deviation_w_per_m2),
                    "it is above 0", "give the noise that the reading has");
  if (r.deviation_w_per_m2 < least_relative_deviation * std::abs(r.irradiance_w_per_m2))
    throw bad_input(fmt::format("{} has a deviation of {} of itself", in_words(i),
                                r.deviation_w_per_m2 / r.irradiance_w_per_m2),
                    fmt::format("the model is good to {}", least_relative_deviation),
                    "give the noise that the reading has");
  const bool places = std::isfinite(r.receiver.x) && std::isfinite(r.receiver.y) &&
                      std::isfinite(r.receiver.yaw.value);
  const bool bearings = !r.has_bearing() || std::isfinite(r.bearing.value);
  if (!(places && bearings && r.bearing_deviation.value >= 0))
    throw bad_input(in_words(i), "place, heading and bearing are numbers", "leave failures out");
}

/// The square around the strongest reading's receiver beyond whose inscribed circle there cannot be
/// as much light: floors at most double it, and the margin is for noise.
Area reachable(const LightModel& model, const std::vector<Reading>& readings) {
  const auto brightest = std::ranges::max_element(
      readings, {}, [](const Reading& r) { return r.irradiance_w_per_m2; });
  const double least = std::max(brightest->irradiance_w_per_m2, brightest->deviation_w_per_m2);
  const double reach = 1.5 * std::sqrt(2 * model.axial.value / least);
  const auto [x, y] = brightest->place();
  return {x - reach, x + reach, y - reach, y + reach};
}

Area search_area(const LocateSettings& settings, const std::vector<Reading>& readings) {
  if (readings.empty()) throw bad_input("no readings", "there is nothing to locate by", "add some");
  for (std::size_t i = 0; i < readings.size(); ++i) check(readings[i], i);
  if (settings.area) return *settings.area;
  if (settings.intensity_unknown)
    throw bad_input("a device of unknown intensity", "it could be anywhere",
                    "say in what area to look");
  return reachable(settings.model, readings);
}

std::size_t numbers_of(const std::vector<Reading>& readings) {
  return readings.size() +
         static_cast<std::size_t>(std::ranges::count_if(readings, &Reading::has_bearing));
}

/// The same minimum reached from two starts: nearer than a millimetre or a tenth of a deviation.
bool is_same(const LocatedPlace& a, const LocatedPlace& b) {
  const double dx = a.at.at.x - b.at.at.x, dy = a.at.at.y - b.at.at.y;
  if (std::hypot(dx, dy) < 1e-3) return true;
  return a.covariance && squared_deviations(*a.covariance, dx, dy) < 0.01;
}

void add_distinct(std::vector<LocatedPlace>& places, const LocatedPlace& place) {
  if (std::ranges::none_of(places,
                           [&](const LocatedPlace& other) { return is_same(other, place); }))
    places.push_back(place);
}

/// Whether the linear picture that the covariance is holds inside of the area.
bool is_determined(const LocatedPlace& place, const Area& area) {
  if (!place.covariance) return false;
  const double diagonal = std::hypot(area.x_max - area.x_min, area.y_max - area.y_min);
  return error_ellipse(*place.covariance).semi_major_m < diagonal;
}

ScatteredLight no_scattered_light(const std::vector<Reading>& readings) {
  return {{}, std::vector<ScatteredLight::Linear>(readings.size())};
}

/// About the least chi-square that scattered light could leave of a place that was found by rays:
/// it may make up for so large a share of each reading.
double least_chi_square(const LeastSquares& problem, const Unknowns& at) {
  constexpr double scattered_share = 0.2;
  std::vector<Reading> readings = problem.readings;
  for (Reading& r : readings)
    r.deviation_w_per_m2 =
        std::hypot(r.deviation_w_per_m2, scattered_share * r.irradiance_w_per_m2);
  return chi_square(problem.model, readings, no_scattered_light(readings), at);
}

/// Leaves the best and those of about its chi-square; the places are sorted by it.
void keep_as_good(std::vector<LocatedPlace>& places, double limit) {
  std::erase_if(places, [best = places.empty() ? 0 : places.front().chi_square,
                         limit](const LocatedPlace& p) { return p.chi_square > best + limit; });
}

double chance(double chi_square, int freedom) {
  return freedom > 0 ? boost::math::gamma_q(freedom / 2.0, chi_square / 2) : 1;
}

LocateOutcome outcome_of(const Location& location, const LocateSettings& settings,
                         const Area& area) {
  if (location.places.empty()) return LocateOutcome::not_converged;
  if (location.degrees_of_freedom < 0 || !is_determined(location.places.front(), area))
    return LocateOutcome::underdetermined;
  if (location.probability < settings.poor_fit_probability) return LocateOutcome::poor_fit;
  return location.places.size() > 1 ? LocateOutcome::ambiguous : LocateOutcome::located;
}

}  // namespace

const std::vector<std::string>& locate_outcome_names() {
  static const std::vector<std::string> names{"located", "ambiguous", "poor_fit", "underdetermined",
                                              "not_converged"};
  return names;
}

void check_readings(const LocateSettings& settings, const std::vector<Reading>& readings) {
  search_area(settings, readings);
}

Locator::Locator(const LocateSettings& settings, const std::vector<Reading>& readings)
    : settings_(settings),
      area_(search_area(settings, readings)),
      grid_(settings.model, readings, area_) {}

void Locator::prepare(const std::vector<Reading>& readings) {
  for (const LocatedPlace& place : places_by_rays(problem_of(readings)))
    prepared_.push_back(scattered_light(settings_.model, readings, place.at.at));
}

LeastSquares Locator::problem_of(const std::vector<Reading>& readings) const {
  return {settings_.model, readings, area_, settings_.intensity_unknown,
          settings_.deviations_are_shares};
}

Location Locator::locate(const std::vector<Reading>& readings) const {
  const LeastSquares problem = problem_of(readings);
  Location location;
  double best = std::numeric_limits<double>::infinity();
  for (const LocatedPlace& by_rays : places_by_rays(problem)) {
    if (least_chi_square(problem, by_rays.at) > best + settings_.ambiguous_chi_square) continue;
    const auto place = polished(problem, by_rays);
    if (!place) continue;
    best = std::min(best, place->chi_square);
    add_distinct(location.places, *place);
  }
  std::ranges::stable_sort(location.places, {}, &LocatedPlace::chi_square);
  location.degrees_of_freedom =
      static_cast<int>(numbers_of(readings)) - (settings_.intensity_unknown ? 3 : 2);
  keep_as_good(location.places, settings_.ambiguous_chi_square);
  if (!location.places.empty())
    location.probability = chance(location.places.front().chi_square, location.degrees_of_freedom);
  location.outcome = outcome_of(location, settings_, area_);
  if (location.outcome == LocateOutcome::underdetermined) location.places.resize(1);
  return location;
}

std::vector<LocatedPlace> Locator::places_by_rays(const LeastSquares& problem) const {
  const ScatteredLight none = no_scattered_light(problem.readings);
  std::vector<LocatedPlace> places;
  for (const Unknowns& start : grid_.starts(problem.readings, problem.intensity_unknown)) {
    const Minimum minimum = descend(problem, none, start);
    if (minimum.converged) add_distinct(places, place_of(problem, minimum, none));
  }
  std::ranges::stable_sort(places, {}, &LocatedPlace::chi_square);
  return places;
}

/// The same with scattered light, which is taken anew until the place stays where that is linear.
std::optional<LocatedPlace> Locator::polished(const LeastSquares& problem,
                                              const LocatedPlace& by_rays) const {
  Unknowns at = by_rays.at;
  for (int i = 0; i < most_polishes; ++i) {
    const ScatteredLight scattered = scattered_near(problem.readings, at.at);
    const Minimum minimum = descend(problem, scattered, at);
    if (!minimum.converged) return std::nullopt;
    const double gone = distance(minimum.at.at, at.at);
    at = minimum.at;
    if (gone <= linear_share * nearest_receiver(problem.readings, at.at))
      return place_of(problem, minimum, scattered);
  }
  return std::nullopt;
}

LocatedPlace Locator::place_of(const LeastSquares& problem, const Minimum& minimum,
                               const ScatteredLight& scattered) const {
  const auto rows = misfit_rows(problem.model, problem.readings, scattered, minimum.at);
  return {minimum.at, minimum.chi_square, position_covariance(rows, problem.intensity_unknown),
          scattered};
}

ScatteredLight Locator::scattered_near(const std::vector<Reading>& readings,
                                       const Position& at) const {
  const double near = prepared_share * nearest_receiver(readings, at);
  for (const ScatteredLight& prepared : prepared_)
    if (distance(prepared.around, at) <= near) return prepared;
  return scattered_light(settings_.model, readings, at);
}

void Locator::add_regions(Location& location, const std::vector<Reading>& readings) const {
  if (location.outcome == LocateOutcome::underdetermined) return;
  const LeastSquares problem = problem_of(readings);
  std::vector<Position> most;
  double least = std::numeric_limits<double>::infinity();
  for (const LocatedPlace& place : location.places) {
    const Likelihood likelihood(problem, place.scattered);
    most.push_back(place.covariance ? most_likely(likelihood, place.at.at, *place.covariance)
                                    : place.at.at);
    least = std::min(least, likelihood(most.back()));
  }
  for (std::size_t i = 0; i < most.size(); ++i) {
    LocatedPlace& place = location.places[i];
    if (place.covariance)
      place.region = likelihood_region(Likelihood(problem, place.scattered), most[i],
                                       *place.covariance, least + chi_square_95, most.size() == 1);
  }
}

bool Locator::region_holds(const Location& location, const std::vector<Reading>& readings,
                           const Position& place) const {
  const LeastSquares problem = problem_of(readings);
  const LocatedPlace& best = location.places.front();
  const Likelihood likelihood(problem, best.scattered);
  const Position most = most_likely(likelihood, best.at.at, best.covariance.value());
  return likelihood(place) <= likelihood(most) + chi_square_95;
}

Location locate(const LocateSettings& settings, const std::vector<Reading>& readings) {
  const Locator locator(settings, readings);
  Location location = locator.locate(readings);
  locator.add_regions(location, readings);
  return location;
}

}  // namespace sim
