#include "sim/location/location_report.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "sim/text/json_answer.hpp"
#include "sim/text/row_table.hpp"

namespace sim {
namespace {

using Json = nlohmann::ordered_json;

const char* meaning(LocateOutcome outcome) {
  switch (outcome) {
    case LocateOutcome::located:
      return "one place explains the readings";
    case LocateOutcome::ambiguous:
      return "several places explain the readings about as well";
    case LocateOutcome::poor_fit:
      return "no place explains the readings; the best is";
    case LocateOutcome::underdetermined:
      return "the readings leave a curve of places; one of it is";
    case LocateOutcome::not_converged:
      break;
  }
  return "no place in the area explains the readings better than all around it";
}

std::string ellipse_words(const LocatedPlace& place, LocateOutcome outcome) {
  if (!place.covariance || outcome == LocateOutcome::underdetermined)
    return "95 % ellipse unbounded";
  if (!place.region) return "outside of the 95 % region";
  const auto& [outline, centre, e] = *place.region;
  return fmt::format(
      "95 % ellipse {:.2g} m by {:.2g} m around ({:.3f}, {:.3f}), the longer at {:.0f} deg from +x",
      e.semi_major_m, e.semi_minor_m, centre.x, centre.y, dsp::in_degrees(e.direction));
}

std::string place_text(const LocatedPlace& place, LocateOutcome outcome) {
  const auto& [at, intensity] = place.at;
  const std::string brightness =
      intensity == 1 ? "" : fmt::format(", intensity {:.3g} of the model's", intensity);
  return fmt::format("  x = {:.3f} m, y = {:.3f} m{}; chi-square {:.2f}; {}\n", at.x, at.y,
                     brightness, place.chi_square, ellipse_words(place, outcome));
}

Json ellipse_json(const LocatedPlace& place) {
  if (!place.region) return nullptr;
  const auto& [outline, centre, e] = *place.region;
  return {{"x_m", centre.x},
          {"y_m", centre.y},
          {"semi_major_m", e.semi_major_m},
          {"semi_minor_m", e.semi_minor_m},
          {"direction_deg", dsp::in_degrees(e.direction)}};
}

Json outline_json(const LocatedPlace& place) {
  if (!place.region) return nullptr;
  Json corners = Json::array();
  for (const auto& [x, y] : place.region->outline) corners.push_back({x, y});
  return corners;
}

Json covariance_json(const LocatedPlace& place) {
  if (!place.covariance) return nullptr;
  return {{"xx", place.covariance->xx}, {"xy", place.covariance->xy}, {"yy", place.covariance->yy}};
}

const std::string& outcome_name(const Location& location) {
  return locate_outcome_names().at(static_cast<std::size_t>(location.outcome));
}

/// What belongs to a place is null.
Json row_without_place(const Location& location) {
  Json row{{"outcome", outcome_name(location)},
           {"degrees_of_freedom", location.degrees_of_freedom},
           {"probability", location.probability}};
  for (const char* name : {"x_m", "y_m", "intensity", "chi_square", "covariance_xx_m2",
                           "covariance_xy_m2", "covariance_yy_m2", "ellipse_x_m", "ellipse_y_m",
                           "ellipse_semi_major_m", "ellipse_semi_minor_m", "ellipse_direction_deg"})
    row[name] = nullptr;
  return row;
}

Json place_row(const Location& location, const LocatedPlace& place) {
  Json row = row_without_place(location);
  row["x_m"] = place.at.at.x;
  row["y_m"] = place.at.at.y;
  row["intensity"] = place.at.intensity;
  row["chi_square"] = place.chi_square;
  if (place.covariance) {
    row["covariance_xx_m2"] = place.covariance->xx;
    row["covariance_xy_m2"] = place.covariance->xy;
    row["covariance_yy_m2"] = place.covariance->yy;
  }
  if (!place.region) return row;
  const auto& [outline, centre, ellipse] = *place.region;
  row["ellipse_x_m"] = centre.x;
  row["ellipse_y_m"] = centre.y;
  row["ellipse_semi_major_m"] = ellipse.semi_major_m;
  row["ellipse_semi_minor_m"] = ellipse.semi_minor_m;
  row["ellipse_direction_deg"] = dsp::in_degrees(ellipse.direction);
  return row;
}

}  // namespace

std::string location_table(const std::filesystem::path& file, const Location& location) {
  std::vector<Json> rows;
  for (const LocatedPlace& place : location.places) rows.push_back(place_row(location, place));
  if (rows.empty()) rows.push_back(row_without_place(location));
  return row_table(file, rows);
}

bool is_location_table(const std::filesystem::path& path) {
  return begins_as_csv(path, "outcome,degrees_of_freedom,probability,") ||
         begins_as_json_lines(path, "outcome");
}

std::string location_text(const Location& location) {
  std::string text = fmt::format("{}: {}\n", outcome_name(location), meaning(location.outcome));
  for (const LocatedPlace& place : location.places) text += place_text(place, location.outcome);
  if (!location.places.empty() && location.degrees_of_freedom > 0)
    text += fmt::format("so large a chi-square of {} degrees of freedom has probability {:.2g}\n",
                        location.degrees_of_freedom, location.probability);
  return text;
}

std::string location_json(const Location& location) {
  Json places = Json::array();
  for (const LocatedPlace& place : location.places)
    places.push_back({{"x_m", place.at.at.x},
                      {"y_m", place.at.at.y},
                      {"intensity", place.at.intensity},
                      {"chi_square", place.chi_square},
                      {"covariance_m2", covariance_json(place)},
                      {"ellipse_95", ellipse_json(place)},
                      {"region_95_m", outline_json(place)}});
  const Json json = {{"outcome", outcome_name(location)},
                     {"degrees_of_freedom", location.degrees_of_freedom},
                     {"probability", location.probability},
                     {"places", places}};
  return json_line(json);
}

}  // namespace sim
