// What a travel that is off does to the readings, by Eq. 2-7 to first order: a reading of the top
// goes with d times the pitch, one of the side with -d times the yaw.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <string>
#include <utility>

#include "algo/uncertainty/effects/reading_covariance.h"
#include "tests/algo/rigs.h"

namespace mdof::algo {
namespace {

constexpr double kPitch_rad = 200e-6, kYaw_rad = -300e-6;

Eigen::MatrixXd covariance_of(const std::string& declared, double travel_m) {
  const Rig rig = test::rig_x_with("", "", declared);
  const Solver solver = Solver::create(rig, Model::rigid).value();
  Errors5 carriage{};
  carriage[kEy] = kPitch_rad;
  carriage[kEz] = kYaw_rad;
  return declared_covariance(rig, solver, travel_m, carriage, std::vector<double>(5, 0.0), 0);
}

void expect_by_travel(const Eigen::MatrixXd& found, double u_m) {
  const double by[] = {kPitch_rad, kPitch_rad, kPitch_rad, -kYaw_rad, -kYaw_rad};
  for (Eigen::Index a = 0; a < 5; ++a)
    for (Eigen::Index b = 0; b < 5; ++b) {
      const double expected = by[a] * by[b] * u_m * u_m;
      EXPECT_NEAR(found(a, b), expected, 1e-3 * std::abs(expected)) << a << b;
    }
}

TEST(EncoderCovariance, IsOfAllReadingsTogether) {
  expect_by_travel(covariance_of("[encoder]\nu_um = 20\n", 0.03), 20e-6);
  EXPECT_EQ(covariance_of("", 0.03).norm(), 0);
}

// A record that has the direction of a probe says it instead of the rig: of a probe of the top by X
// and Y, of the side by X and Z.
TEST(CalibratedDirections, TakeThePlaceOfTheRigs) {
  for (const auto& [id, across] : {std::pair("A", 1U), {"B", 1U}, {"D", 2U}, {"E", 2U}}) {
    const auto covariance = [&, id = std::string(id)](const std::string& keys) {
      Rig rig = test::rig_x_with(id, keys);
      CalibrationRecord& record = rig.records.emplace_back();
      record.covariance.of = {direction_name(id, 0), direction_name(id, across)};
      record.covariance.m2 = {{4e-8, 1e-8}, {1e-8, 9e-8}};
      const Solver solver = Solver::create(rig, Model::rigid).value();
      Errors5 carriage{};
      carriage[kEx] = carriage[kEy] = carriage[kEz] = 1e-3;
      return declared_covariance(rig, solver, 0.03, carriage, std::vector<double>(5, 0.0), 0);
    };
    const Eigen::MatrixXd recorded = covariance("");
    EXPECT_GT(recorded.norm(), 0) << id;
    EXPECT_EQ((covariance("u_direction_mrad = 5") - recorded).norm(), 0) << id;
  }
}

}  // namespace
}  // namespace mdof::algo
