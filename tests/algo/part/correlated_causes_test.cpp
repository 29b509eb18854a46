// Causes whose uncertainties are correlated. Expected values are calculated from the covariance
// matrix (GUM 5.2.2), not from its triangular factor.
#include <gtest/gtest.h>

#include <cmath>

#include "algo/part/machine_causes.h"
#include "algo/part/part_error.h"

namespace mdof::algo {
namespace {

using Field = std::vector<Eigen::Vector3d>;
constexpr std::size_t kCausePoints = 50;

Field field_along_z(double value) {
  return Field(kCausePoints, Eigen::Vector3d(0, 0, value));
}

PartPath path() {
  PartPath path;
  for (std::size_t k = 0; k < kCausePoints; ++k)
    path.at_m.emplace_back(1e-3 * static_cast<double>(k), 0.1, 0);
  return path;
}

PartCause cause(double value_m, double u_of_number_7_m) {
  return {0, "c", field_along_z(value_m), field_along_z(0), {{7, field_along_z(u_of_number_7_m)}}};
}

// The errors 3 + 0.2 eta and 1 - 0.2 eta have the sum 4 for each eta, so its U is 0.
TEST(CorrelatedCauses, UOfASumContainsTheCovariance) {
  const PartTrials trials{.seed = 3, .shares = 4000, .errors = 4000};
  const PartError found =
      part_error(path(), {cause(3e-6, 0.2e-6), cause(1e-6, -0.2e-6)}, 1, trials);
  EXPECT_NEAR(found.layers[0].rms_m, 4e-6, 1e-15);
  EXPECT_NEAR(found.layers[0].rms_interval_m.U(found.layers[0].rms_m), 0, 1e-15);
  EXPECT_NEAR(found.max_m, 4e-6, 1e-15);
  EXPECT_NEAR(found.max_interval_m.U(found.max_m), 0, 1e-15);
  for (const PartShare& share : found.causes)
    EXPECT_NEAR(share.rms_interval_m.U(share.rms_m), 1.96 * 0.2e-6, 0.02e-6);
  // With the same sign the sum is 4 + 0.4 eta.
  const PartError same = part_error(path(), {cause(3e-6, 0.2e-6), cause(1e-6, 0.2e-6)}, 1, trials);
  EXPECT_NEAR(same.layers[0].rms_interval_m.U(same.layers[0].rms_m), 1.96 * 0.4e-6, 0.04e-6);
  EXPECT_NEAR(same.max_interval_m.U(same.max_m), 1.96 * 0.4e-6, 0.04e-6);
}

// Causes with u and without value: the expected mean square of their sum contains the covariance.
TEST(CorrelatedCauses, ExpectedSquareOfALayerContainsTheCovariance) {
  const PartError found = part_error(path(), {cause(0, 2e-6), cause(0, -1.5e-6)}, 1);
  EXPECT_NEAR(found.layers[0].rms_m, 0.5e-6, 1e-15);
  EXPECT_NEAR(found.causes[0].rms_m, 2e-6, 1e-15);
  EXPECT_NEAR(found.causes[1].rms_m, 1.5e-6, 1e-15);
}

double common_square(const PartCause& cause, std::size_t point) {
  double square = cause.u_m[point].squaredNorm();
  for (const CommonPart& part : cause.common) square += part.u_m[point].squaredNorm();
  return square;
}

// X carries the work. EYX moves the tool along Y only, ECX along X by the arm of 100 mm in Y. A
// quantity with the effects 0.4 µm and 3 µrad is shared with another axis.
TEST(CorrelatedCauses, EachErrorOfAnAxisHasItsOwnU) {
  auto machine = parse_machine(
      "name = \"m\"\nmachine = {chain = \"w-X-b-Y-t\"}\ntool = {point_mm = [0, 0, 0]}\n"
      "[[axis]]\nid = \"X\"\nholds_at_mm = [0, 0, 0]\npoint = \"standing\"\n"
      "[[axis]]\nid = \"Y\"\nholds_at_mm = [0, 0, 0]\npoint = \"moving\"\n",
      "m");
  ASSERT_TRUE(machine) << machine.error().message;
  MachineFrame& x = machine->frames[0];
  ErrorCovariance& all = x.covariance;
  const double u_EY = 0.3e-6, u_EC = 8e-6;
  all.position = {0};
  all.noise.assign(1, {});
  all.declared.assign(1, {});
  all.has[1] = all.has[5] = true;
  all.declared[0][1][1] = u_EY * u_EY;
  all.declared[0][5][5] = u_EC * u_EC;
  all.declared[0][1][5] = all.declared[0][5][1] = 0.8 * u_EY * u_EC;
  all.shared = {{"probe A: sensitivity", {{0, 0.4e-6, 0, 0, 0, 3e-6}}}};
  x.error[1].forward = x.error[5].forward = {0};
  const MachineCauses found = machine_causes(*machine, path().at_m);
  ASSERT_EQ(found.axes.size(), 2u);  // the shared quantity is part of both errors
  EXPECT_EQ(found.axes[0].name, "EYX");
  EXPECT_EQ(found.axes[1].name, "ECX");
  EXPECT_NEAR(common_square(found.axes[0], 0), std::pow(0.3e-6, 2) + std::pow(0.4e-6, 2), 1e-24);
  EXPECT_NEAR(common_square(found.axes[1], 0), (64 + 9) * 1e-14, 1e-24);
}

}  // namespace
}  // namespace mdof::algo
