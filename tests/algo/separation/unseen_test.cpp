// Names of shapes that a separation does not determine. The shapes are defined by hand.
#include "algo/separation/unseen.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace mdof::algo {
namespace {

const std::vector<double> kPlaces = {0, 10e-3, 20e-3, 30e-3, 40e-3, 50e-3};

// Orthonormal columns that span the given shapes.
Eigen::MatrixXd unseen(const std::vector<std::vector<double>>& shapes) {
  Eigen::MatrixXd columns(6, static_cast<Eigen::Index>(shapes.size()));
  for (Eigen::Index k = 0; k < columns.cols(); ++k) {
    for (Eigen::Index i = 0; i < 6; ++i)
      columns(i, k) = shapes[static_cast<std::size_t>(k)][static_cast<std::size_t>(i)];
    for (int twice = 0; twice < 2; ++twice)
      for (Eigen::Index before = 0; before < k; ++before)
        columns.col(k) -= columns.col(before).dot(columns.col(k)) * columns.col(before);
    columns.col(k).normalize();
  }
  return columns;
}

std::string named(const std::vector<std::vector<double>>& shapes,
                  const std::vector<double>& periods_m = {}) {
  std::string text;
  for (const UndeterminedShape& shape : named_shapes(kPlaces, unseen(shapes), periods_m))
    text += shape.name + " (" + std::to_string(shape.dimensions) + ")\n";
  return text;
}

const std::vector<double> kOnes(6, 1.0), kLine = {0, 1, 2, 3, 4, 5}, kSquares = {0, 1,  4,
                                                                                 9, 16, 25};

TEST(UnseenShapes, AreNamedOffsetSlopeAndParabola) {
  EXPECT_EQ(named({kOnes}), "offset (1)\n");
  EXPECT_EQ(named({kLine, kOnes}), "offset (1)\nslope (1)\n");
  EXPECT_EQ(named({kOnes, kLine, kSquares}), "offset (1)\nslope (1)\nparabola (1)\n");
  // A line about the middle contains no offset, so its name is slope.
  EXPECT_EQ(named({{-5, -3, -1, 1, 3, 5}}), "slope (1)\n");
  // A line that starts at 0 contains an offset, and the offset is determined. So this shape is
  // neither an offset nor a slope.
  EXPECT_EQ(named({kLine}), "1 more shape, from 10 mm to 50 mm (1)\n");
}

TEST(UnseenShapes, PeriodHasTwoShapesOrOneIfTwoStepsLong) {
  std::vector<double> sine, cosine;
  for (int i = 0; i < 6; ++i) {
    sine.push_back(std::sin(2 * std::numbers::pi * i / 3));
    cosine.push_back(std::cos(2 * std::numbers::pi * i / 3));
  }
  EXPECT_EQ(named({sine, cosine}, {30e-3}), "period 30 mm (2)\n");
  EXPECT_EQ(named({{1, -1, 1, -1, 1, -1}}, {20e-3}), "period 20 mm (1)\n");
  EXPECT_EQ(named({{1, -1, 1, -1, 1, -1}}, {30e-3}),
            "1 more shape antisymmetric about 25 mm (1)\n");
}

TEST(UnseenShapes, UnnamedShapesHaveSymmetryOrRange) {
  EXPECT_EQ(named({{1, 0, 0, 0, 0, 1}}), "1 more shape symmetric about 25 mm (1)\n");
  EXPECT_EQ(named({{0, 1, 0, 0, -1, 0}}), "1 more shape antisymmetric about 25 mm (1)\n");
  EXPECT_EQ(named({{1, 0, 0, 0, 0, 1}, {0, 1, 0, 0, 1, 0}}),
            "2 more shapes symmetric about 25 mm (2)\n");
  EXPECT_EQ(named({{0, 1, 2, 0, 0, 0}}), "1 more shape, from 10 mm to 20 mm (1)\n");
  EXPECT_EQ(named({kOnes, {0, 0, 0, 0, 0, 1}}),
            "offset (1)\n1 more shape, from 0 mm to 50 mm (1)\n");
  const auto uneven =
      named_shapes({0, 10e-3, 20e-3, 30e-3, 40e-3, 60e-3}, unseen({{1, 0, 0, 0, 0, 1}}), {});
  ASSERT_EQ(uneven.size(), 1u);
  EXPECT_EQ(uneven[0].name, "1 more shape, from 0 mm to 60 mm");
}

TEST(HiddenPeriods, AreTheGreatestCommonDivisorAndItsFractions) {
  const auto mm = [](const std::vector<double>& ways_mm, double step_mm) {
    std::vector<double> ways;
    for (const double way : ways_mm) ways.push_back(1e-3 * way);
    std::vector<double> periods;
    for (const double p : hidden_periods(ways, 1e-3 * step_mm, 0.1e-3))
      periods.push_back(std::round(p * 1e6) / 1e3);
    return periods;
  };
  EXPECT_EQ(mm({20, -30}, 2), (std::vector<double>{10, 5}));
  EXPECT_EQ(mm({20, 30.05}, 2.4), (std::vector<double>{10.05, 5.025}));
  EXPECT_EQ(mm({20}, 5), (std::vector<double>{20, 10}));
  EXPECT_EQ(mm({20}, 2), (std::vector<double>{20, 10, 6.667, 5, 4}));
  EXPECT_EQ(mm({20}, 10.2), (std::vector<double>{}));
  EXPECT_EQ(mm({20}, 0), (std::vector<double>{}));
  EXPECT_EQ(mm({}, 2), (std::vector<double>{}));
}

// A shape is reported as not determined if less than a millionth of it is determined, for any
// number of places. The column is an offset that is rotated towards the shape +1, -1 ... by the
// angle `by`.
TEST(UnseenShapes, UpToAMillionthOfAShapeMayBeDetermined) {
  const auto turned = [](double by) {
    std::vector<double> shape;
    for (int i = 0; i < 6; ++i) shape.push_back(1 + (i % 2 == 0 ? by : -by));
    return shape;
  };
  EXPECT_EQ(named({turned(6e-7)}), "offset (1)\n");
  EXPECT_EQ(named({turned(1.2e-6)}), "1 more shape symmetric about 25 mm (1)\n");
}

}  // namespace
}  // namespace mdof::algo
