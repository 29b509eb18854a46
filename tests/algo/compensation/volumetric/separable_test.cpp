// Corrections as sums and products of functions of one axis, for grids of known functions.
#include "algo/compensation/volumetric/separable.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace mdof::algo {
namespace {

using CorrectionFunction = double (*)(double x, double y, double z);

VolumetricTable function_table(CorrectionFunction f, std::size_t nx = 5, std::size_t ny = 4,
                               std::size_t nz = 3) {
  VolumetricTable t;
  const std::array<std::size_t, 3> n{nx, ny, nz};
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < n[k]; ++i) t.command_m[k].push_back(0.01 * static_cast<double>(i));
  for (std::size_t node = 0; node < t.nodes(); ++node) {
    const Vec3 at = t.command_at(node);
    t.correction_m.push_back({0, f(at[0], at[1], at[2]), 0});
  }
  return t;
}

// Largest residual of the correction; the sum is calculated by its definition.
double largest_left(const VolumetricTable& t, const SeparableCorrection& sum) {
  double most = 0;
  for (std::size_t node = 0; node < t.nodes(); ++node) {
    const std::size_t nx = t.command_m[0].size(), ny = t.command_m[1].size();
    const std::array<std::size_t, 3> i{node % nx, node / nx % ny, node / (nx * ny)};
    double value = 0;
    for (std::size_t k = 0; k < 3; ++k)
      if (!sum.along[k].empty()) value += sum.along[k][i[k]];
    for (const AxisProduct& p : sum.products)
      value += p.of_first[i[p.first]] * p.of_second[i[p.second]];
    most = std::max(most, std::abs(t.correction_m[node][1] - value));
  }
  return most;
}

TEST(Separable, SumsNeedNoProducts) {
  const auto t = function_table(
      [](double x, double y, double z) { return 3e-6 + 1e-4 * x * x - 2e-5 * y + 1e-5 * z * z; });
  const auto sum = separate(t, 1, 1e-12);
  EXPECT_TRUE(sum.products.empty());
  EXPECT_LT(sum.left_m, 1e-20);
  EXPECT_LT(largest_left(t, sum), 1e-20);
}

TEST(Separable, AngleWithItsLeverIsOneProduct) {
  // Roll of X acts with the lever Z, yaw of X with the lever Y.
  const auto t = function_table([](double x, double y, double z) {
    return 1e-6 * std::sin(100 * x) * (z - 0.02) + 2e-3 * x * x * y;
  });
  const auto sum = separate(t, 1, 1e-13);
  EXPECT_EQ(sum.products.size(), 2U);
  EXPECT_LT(largest_left(t, sum), 1e-13);
  for (const AxisProduct& p : sum.products) {  // both factors have the same largest value
    double first = 0, second = 0;
    for (const double x : p.of_first) first = std::max(first, std::abs(x));
    for (const double x : p.of_second) second = std::max(second, std::abs(x));
    EXPECT_NEAR(first / second, 1, 1e-12);
  }
}

TEST(Separable, ReportsTheResidualOfAProductOfThreeAxes) {
  const auto t = function_table([](double x, double y, double z) { return x * y * z; });
  const auto sum = separate(t, 1, 1e-12);
  EXPECT_GT(sum.left_m, 1e-7);
  EXPECT_NEAR(largest_left(t, sum), sum.left_m, 1e-18);
}

TEST(Separable, PlaneHasFunctionsOfItsTwoAxesOnly) {
  const auto t = function_table([](double x, double y, double) { return 1e-3 * x * y; }, 5, 4, 1);
  const auto sum = separate(t, 1, 1e-12);
  EXPECT_EQ(sum.along[0].size(), 5U);
  EXPECT_TRUE(sum.along[2].empty());
  EXPECT_EQ(sum.products.size(), 1U);
  EXPECT_LT(largest_left(t, sum), 1e-15);
  EXPECT_EQ(separate(t, 0, 1e-12).left_m, 0);  // X needs no correction
}

// With two nodes of each axis, the sums contain the mean and half of the differences. The product
// contains a quarter of the alternating sum of the four nodes. The residual is 0.
TEST(Separable, TwoNodesOfEachAxisAreEnough) {
  const auto t = function_table([](double x, double y, double) { return 1e-3 * x * y; }, 2, 2, 1);
  const auto sum = separate(t, 1, 1e-12);
  ASSERT_EQ(sum.products.size(), 1U);
  EXPECT_NEAR(sum.products[0].of_first[1] * sum.products[0].of_second[1], 1e-7 / 4, 1e-20);
  EXPECT_LT(largest_left(t, sum), 1e-20);
  for (const auto& [nx, ny] : {std::pair<std::size_t, std::size_t>{2, 1}, {1, 2}})
    EXPECT_TRUE(
        separate(function_table([](double x, double y, double z) { return x + y + z; }, nx, ny, 2),
                 1, 1e-12)
            .products.empty());
  const auto upright =
      function_table([](double x, double y, double z) { return 1e-3 * (x * z + y * z); }, 2, 2, 2);
  EXPECT_EQ(separate(upright, 1, 1e-12).products.size(), 2U);
  EXPECT_LT(separate(upright, 1, 1e-12).left_m, 1e-20);
}

}  // namespace
}  // namespace mdof::algo
