// The covariance of a surface is compared with the closed form, which uses the Bessel function of
// the standard library. It is also compared with sums of many plane waves with random directions
// and phases; the simplified model (Eq. 8-12) evaluates their heights.
#include "algo/uncertainty/effects/flatness.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "algo/uncertainty/budget/budget.h"
#include "algo/uncertainty/run_uncertainty.h"
#include "tests/algo/rigs.h"
#include "tests/algo/uncertainty/drawn_surface.h"
#include "tests/algo/uncertainty/synthetic_run.h"

namespace mdof::algo {
namespace {

constexpr double kU_m = 0.05e-6;

TEST(Flatness, BesselFunctionMatchesTheStandardLibrary) {
  for (double x = 0; x < 400; x += 0.0371)
    EXPECT_NEAR(one_minus_bessel_j0(x), 1 - std::cyl_bessel_j(0, x), 5e-11) << x;
  for (const double x : {1e-6, 1e-4, 1e-2})
    EXPECT_NEAR(one_minus_bessel_j0(x) / (x * x / 4), 1 - x * x / 16, 1e-9) << x;
}

double covariance_m2(double apart_m, double length_m) {
  double sum = 0, norm = 0;
  for (int k = 1; k <= 4; ++k) {
    sum += std::pow(k, -4) * std::cyl_bessel_j(0, 2 * M_PI * k * apart_m / length_m);
    norm += std::pow(k, -4);
  }
  return kU_m * kU_m * sum / norm;
}

// Three probes move over 60 mm; the longest wave is from 6 mm to 600 mm.
TEST(Flatness, PartsHaveTheCovarianceForAnyLength) {
  for (const double length_mm : {6.0, 20.0, 60.0, 200.0, 600.0}) {
    std::vector<Footprint> prints;
    for (const auto& [x, y] : {std::array{10e-3, 0.0}, {0.0, 10e-3}, {0.0, -10e-3}})
      for (int i = 0; i <= 10; ++i) {
        const Eigen::Vector3d zero(x, y, 0);
        prints.push_back({zero - Eigen::Vector3d(i * 6e-3, 0, 0), zero});
      }
    const Eigen::MatrixXd parts = independent_heights({kU_m, length_mm * 1e-3}, prints);
    const Eigen::MatrixXd found = parts * parts.transpose();
    double most = 0;
    const auto c = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
      return covariance_m2((a - b).norm(), length_mm * 1e-3);
    };
    for (std::size_t i = 0; i < prints.size(); ++i)
      for (std::size_t j = 0; j < prints.size(); ++j) {
        const Footprint &a = prints[i], &b = prints[j];
        const double exact =
            c(a.place, b.place) - c(a.place, b.zero) - c(a.zero, b.place) + c(a.zero, b.zero);
        const auto at = found(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
        most = std::max(most, std::abs(at - exact) / (kU_m * kU_m));
      }
    EXPECT_LT(most, 2e-9) << length_mm << " mm";
    EXPECT_LE(parts.cols(), 33) << length_mm;
  }
}

// Thousands of positions on a surface. The number of parts is limited, and their variance is at
// least the variance of the surface.
TEST(Flatness, PartsAreBoundedAndKeepTheVariance) {
  for (const double length_mm : {1.0, 30.0}) {
    std::vector<Footprint> prints;
    for (int i = 0; i < 2000; ++i)
      prints.push_back({Eigen::Vector3d(-i * 50e-6, 0, 0), Eigen::Vector3d::Zero()});
    const Eigen::MatrixXd parts = independent_heights({kU_m, length_mm * 1e-3}, prints);
    EXPECT_LE(parts.cols(), length_mm > 10 ? 60 : static_cast<int>(kMostFlatnessParts));
    for (std::size_t i = 500; i < prints.size(); i += 100) {
      const double exact =
          2 * (kU_m * kU_m - covariance_m2(static_cast<double>(i) * 50e-6, length_mm * 1e-3));
      EXPECT_NEAR(parts.row(static_cast<Eigen::Index>(i)).squaredNorm() / exact, 1, 1e-6) << i;
    }
  }
}

// Default fixture: l = 10 mm, l'' = 20 mm, l' = 15 mm; EYX = D + (B - C)/2l · l''.
TEST(Flatness, UOfSlopeAndPointsMatchesDrawnSurfaces) {
  const std::vector<double> targets_m = {0, 5e-3, 10e-3, 15e-3, 20e-3, 25e-3, 30e-3, 35e-3, 40e-3};
  for (const double length_mm : {4.0, 13.0, 40.0, 120.0, 400.0}) {
    SCOPED_TRACE(length_mm);
    const std::string plane =
        "u_flatness_um = 0.05\nflatness_length_mm = " + std::to_string(length_mm) + "\n";
    const Rig rig = test::rig_x_with("", "",
                                     "[[plane]]\nid = \"top\"\nnormal = \"+Z\"\n" + plane +
                                         "[[plane]]\nid = \"side\"\nnormal = \"+Y\"\n" + plane);
    SyntheticRun synthetic{.rig = rig, .model = Model::simplified, .targets_m = targets_m};
    const auto run = synthetic.measure();
    const auto budgets = RunBudgets::create(rig, run).value();
    const double u_slope = budgets.first_order(slope_figure(Axis::x, 0)).u;
    const double u_point = run_uncertainty(rig, run).points[8].u[0];
    std::mt19937_64 engine(7);
    constexpr int kSurfaces = 3000;
    double slope_square = 0, point_square = 0;
    for (int s = 0; s < kSurfaces; ++s) {
      const test_faults::DrawnSurface top(kU_m, length_mm * 1e-3, engine);
      const test_faults::DrawnSurface side(kU_m, length_mm * 1e-3, engine);
      double sxy = 0, point = 0;
      for (const double d : targets_m) {
        const double roll =
            (top.above_zero_m(0, 10e-3, d) - top.above_zero_m(0, -10e-3, d)) / 20e-3;
        point = side.above_zero_m(0, 20e-3, d) + 20e-3 * roll;
        sxy += (d - 20e-3) * point;
      }
      const double slope = sxy / (25e-6 * 60);
      slope_square += slope * slope / kSurfaces;
      point_square += point * point / kSurfaces;
    }
    // The relative standard uncertainty of both root mean squares is 1.3 % for this number of
    // surfaces.
    EXPECT_NEAR(u_slope / std::sqrt(slope_square), 1, 0.05);
    EXPECT_NEAR(u_point / std::sqrt(point_square), 1, 0.05);
  }
}

}  // namespace
}  // namespace mdof::algo
