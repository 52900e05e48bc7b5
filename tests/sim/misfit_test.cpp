// Slopes, information and the Cramer-Rao bound beside closed forms and differences.
#include "sim/location/misfit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "location_scenes.hpp"
#include "sim/location/position_covariance.hpp"

namespace sim {
namespace {

constexpr Position device_place{1.1, 0.7};

/// Misfits by the whole model, nothing of it linear.
std::vector<double> misfits(const LightModel& model, const std::vector<Reading>& readings,
                            const Unknowns& u) {
  std::vector<double> all;
  for (const Reading& r : readings)
    all.push_back((r.irradiance_w_per_m2 - u.intensity * received_light(model, u.at, r.receiver)) /
                  r.deviation_w_per_m2);
  for (const Reading& r : readings)
    if (r.has_bearing()) all.push_back(-bearing_error(r, u.at) / r.bearing_deviation.value);
  return all;
}

void expect_slopes_of_differences(const LightModel& model, std::vector<Reading> readings) {
  const Unknowns here{device_place, 1.3};
  const auto rows =
      misfit_rows(model, readings, scattered_light(model, readings, device_place), here);
  constexpr double h = 3e-3;
  for (int unknown = 0; unknown < 3; ++unknown) {
    Unknowns above = here, below = here;
    double* const up[] = {&above.at.x, &above.at.y, &above.intensity};
    double* const down[] = {&below.at.x, &below.at.y, &below.intensity};
    *up[unknown] += h;
    *down[unknown] -= h;
    const auto more = misfits(model, readings, above), less = misfits(model, readings, below);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const double slope = -(more[i] - less[i]) / (2 * h);
      EXPECT_NEAR(rows[i].slope.at(static_cast<std::size_t>(unknown)), slope,
                  1e-3 * std::abs(slope) + 1e-3)
          << i << " " << unknown;
    }
  }
}

TEST(Misfit, SlopesAreThoseOfDifferences) {
  for (const LightModel& model : {inverse_square(), indoors()}) {
    auto readings = readings_of(model, {1.3, 0.6}, four_corners());
    for (Reading& reading : readings) reading.deviation_w_per_m2 = 1e-4;
    add_bearings(readings, {1.3, 0.6}, 3);
    expect_slopes_of_differences(model, readings);
  }
}

TEST(Misfit, ChiSquareIsTheSumOfSquares) {
  const LightModel model = indoors();
  auto readings = readings_of(model, {1.3, 0.6}, four_corners());
  add_bearings(readings, {1.3, 0.6}, 3);
  const ScatteredLight scattered = scattered_light(model, readings, device_place);
  double sum = 0;
  for (const double misfit : misfits(model, readings, {device_place, 1.3})) sum += misfit * misfit;
  double of_rows = 0;
  for (const MisfitRow& row : misfit_rows(model, readings, scattered, {device_place, 1.3}))
    of_rows += row.misfit * row.misfit;
  EXPECT_NEAR(chi_square(model, readings, scattered, {device_place, 1.3}), sum, 1e-9 * sum);
  EXPECT_NEAR(of_rows, sum, 1e-9 * sum);
}

TEST(Misfit, BearingsAreFromTheHeadingAndWrapped) {
  Reading reading = from(receiver_at(1, 1, 170));
  reading.bearing = dsp::degrees(30);  // 200 degrees, that is -160
  const double degree = dsp::degrees(1).value;
  const double d = dsp::degrees(-158).value;
  EXPECT_NEAR(bearing_error(reading, {1 + std::cos(d), 1 + std::sin(d)}), 2 * degree, 1e-12);
}

TEST(ScatteredLight, IsTheModelsAroundThePlace) {
  const LightModel model = indoors();
  const auto readings = readings_of(model, device_place, four_corners());
  const ScatteredLight scattered = scattered_light(model, readings, device_place);
  const Position aside{device_place.x + 0.01, device_place.y - 0.01};
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const channel::Pose& receiver = readings[i].receiver;
    const double diffuse =
        received_light(model, aside, receiver) - ray_light(model, aside, receiver);
    EXPECT_NEAR(scattered.of(i, aside), diffuse, 2e-3 * diffuse) << i;
  }
}

/// E = A / d^2 falls by 2 A / d^3 along the ray, nothing across it. With a deviation of a share s
/// of E the information is the sum of 4 / (s d)^2 u u^T, u the unit vector from receiver to device.
TEST(CramerRaoBound, IsTheClosedFormOfAnInverseSquareLaw) {
  constexpr double share = 0.02;
  const auto readings = readings_of(inverse_square(), device_place, four_corners(), share);
  double xx = 0, xy = 0, yy = 0;
  for (const Reading& r : readings) {
    const double dx = device_place.x - r.receiver.x, dy = device_place.y - r.receiver.y;
    const double weight = 4 / (share * share) / std::pow(dx * dx + dy * dy, 2);
    xx += weight * dx * dx;
    xy += weight * dx * dy;
    yy += weight * dy * dy;
  }
  const double determinant = xx * yy - xy * xy;
  const auto bound = cramer_rao_bound(inverse_square(), readings, device_place, false);
  ASSERT_TRUE(bound.has_value());
  EXPECT_NEAR(bound->xx * determinant / yy, 1, 1e-7);
  EXPECT_NEAR(bound->xy * determinant / -xy, 1, 1e-7);
  EXPECT_NEAR(bound->yy * determinant / xx, 1, 1e-7);
}

/// One receiver at d: s d / 2 along the ray by intensity, d times its deviation across by bearing.
TEST(CramerRaoBound, OfIntensityAndBearingIsAlongAndAcross) {
  auto readings = readings_of(inverse_square(), {0, 2}, {receiver_at(0, 0, 90)}, 0.1);
  add_bearings(readings, {0, 2}, 1);
  const auto bound = cramer_rao_bound(inverse_square(), readings, {0, 2}, false);
  ASSERT_TRUE(bound.has_value());
  EXPECT_NEAR(std::sqrt(bound->yy), 0.1 * 2 / 2, 1e-6);
  EXPECT_NEAR(std::sqrt(bound->xx), 2 * dsp::degrees(1).value, 1e-6);
}

TEST(CramerRaoBound, IsNothingForARing) {
  const auto readings = readings_of(inverse_square(), device_place, {receiver_at(0, 0, 0)});
  EXPECT_FALSE(cramer_rao_bound(inverse_square(), readings, device_place, false).has_value());
  const auto twice =
      readings_of(inverse_square(), device_place, {receiver_at(0, 0, 0), receiver_at(0, 0, 0)});
  EXPECT_FALSE(cramer_rao_bound(inverse_square(), twice, device_place, false).has_value());
}

TEST(CramerRaoBound, IsLargerWhereTheIntensityIsUnknown) {
  const auto readings = readings_of(inverse_square(), device_place, four_corners());
  EXPECT_GT(cramer_rao_bound(inverse_square(), readings, device_place, true)->rms(),
            cramer_rao_bound(inverse_square(), readings, device_place, false)->rms());
}

TEST(ErrorEllipse, OfATurnedCovariance) {  // axes 3 and 1, the major at 30 degrees
  const double c = std::cos(dsp::degrees(30).value), s = std::sin(dsp::degrees(30).value);
  const PositionCovariance covariance{9 * c * c + s * s, 8 * s * c, 9 * s * s + c * c};
  const ErrorEllipse ellipse = error_ellipse(covariance);
  EXPECT_NEAR(ellipse.semi_major_m, 3 * 2.4477, 1e-3);  // sqrt(5.991)
  EXPECT_NEAR(ellipse.semi_minor_m, 1 * 2.4477, 1e-3);
  EXPECT_NEAR(ellipse.direction.value, dsp::degrees(30).value, 1e-12);
  EXPECT_NEAR(squared_deviations(covariance, 3 * c, 3 * s), 1, 1e-12);
  EXPECT_NEAR(squared_deviations(covariance, -s, c), 1, 1e-12);
  EXPECT_NEAR(covariance.rms(), std::sqrt(10), 1e-12);
}

}  // namespace
}  // namespace sim
