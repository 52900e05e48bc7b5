#pragma once
// Where is the device? From the intensity, and if measured the bearing, that several receivers or
// several headings of one robot have: least squares with the light's whole model inside, from
// several starts, so that a second place that would explain the readings as well is found and said.
#include <optional>
#include <string>
#include <vector>

#include "sim/location/gauss_newton.hpp"
#include "sim/location/likelihood_region.hpp"
#include "sim/location/search_grid.hpp"

namespace sim {

enum class LocateOutcome {
  located,
  ambiguous,        // other places explain the readings about as well: all are given
  poor_fit,         // no place explains them: chi-square would be as large by chance once in 1000
  underdetermined,  // too few readings, or such as leave a curve of places; one of it is given
  not_converged     // no minimum inside of the area
};

/// Their names, in the order of the enumeration.
const std::vector<std::string>& locate_outcome_names();

struct LocateSettings {
  LightModel model;
  bool intensity_unknown = false;      // then the area is needed
  bool deviations_are_shares = false;  // of the light itself, but computed of the reading
  std::optional<Area> area;            // where the device may be; nothing: what the light allows
  double ambiguous_chi_square = chi_square_95;  // above the best: as good as it
  double poor_fit_probability = 1e-3;
};

struct LocatedPlace {
  Unknowns at;
  double chi_square = 0;
  std::optional<PositionCovariance> covariance;  // nothing where it is not determined
  ScatteredLight scattered;                      // as it was taken
  std::optional<LikelihoodRegion> region{};      // of add_regions
};

struct Location {
  LocateOutcome outcome = LocateOutcome::not_converged;
  std::vector<LocatedPlace> places;  // the best first; several if ambiguous, none if not converged
  int degrees_of_freedom = 0;        // numbers measured less unknowns
  double probability = 1;            // of so large a chi-square by chance; 1 without freedom
};

/// Throws bad_input for readings that cannot be.
void check_readings(const LocateSettings& settings, const std::vector<Reading>& readings);

/// Receivers at their places, for readings of any light.
class Locator {
 public:
  /// Only places, headings and deviations of the readings are kept, and for an area that is not
  /// set the strongest one. Throws as check_readings.
  Locator(const LocateSettings& settings, const std::vector<Reading>& readings);

  /// Computes scattered light around all places where such readings may lead, once for all: good
  /// for many readings of one device.
  void prepare(const std::vector<Reading>& readings);

  Location locate(const std::vector<Reading>& readings) const;

  /// Gives each place that is determined its part of the 95 % region, which takes some
  /// milliseconds: where likelihood is near to that of the most likely of all.
  void add_regions(Location& location, const std::vector<Reading>& readings) const;

  /// Whether the first place's region holds a place, without its outline.
  bool region_holds(const Location& location, const std::vector<Reading>& readings,
                    const Position& place) const;

 private:
  ScatteredLight scattered_near(const std::vector<Reading>& readings, const Position& at) const;
  LocatedPlace place_of(const LeastSquares& problem, const Minimum& minimum,
                        const ScatteredLight& scattered) const;
  LeastSquares problem_of(const std::vector<Reading>& readings) const;
  std::vector<LocatedPlace> places_by_rays(const LeastSquares& problem) const;
  std::optional<LocatedPlace> polished(const LeastSquares& problem,
                                       const LocatedPlace& by_rays) const;

  LocateSettings settings_;
  Area area_;
  SearchGrid grid_;
  std::vector<ScatteredLight> prepared_;
};

/// One set of readings, with regions.
Location locate(const LocateSettings& settings, const std::vector<Reading>& readings);

}  // namespace sim
