// Shares of simulated causes. They are compared with closed forms, and the test counts how often U
// contains the true share.
#include "algo/part/part_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace mdof::algo {
namespace {

using Field = std::vector<Eigen::Vector3d>;
constexpr std::size_t kPoints = 200;

PartPath path_of(bool with_normals) {
  PartPath path;
  for (std::size_t k = 0; k < kPoints; ++k) {
    path.at_m.emplace_back(static_cast<double>(k) * 1e-3, 0, 0);
    if (with_normals) path.normal.emplace_back(0, 0, 1);
  }
  return path;
}

// Four errors along the path. Each cause is a multiple of one of them.
Field shape(int k) {
  Field field;
  for (std::size_t p = 0; p < kPoints; ++p) {
    const double t = static_cast<double>(p) / kPoints;
    const double z = k == 0 ? 2 * t - 1 : k == 1 ? 1 : k == 2 ? std::sin(9 * t) : t * t;
    field.emplace_back(0.3 * z, 0, z);
  }
  return field;
}
Field times(const Field& field, double factor) {
  Field result = field;
  for (Eigen::Vector3d& v : result) v *= factor;
  return result;
}
double mean_square(const Field& field) {
  double sum = 0;
  for (const Eigen::Vector3d& v : field) sum += v(2) * v(2);
  return sum / kPoints;
}

TEST(PartError, SharesMatchTheClosedForm) {
  const double size[] = {2e-6, 1e-6, 0.5e-6};
  std::vector<PartCause> causes;
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    causes.push_back({static_cast<std::size_t>(k), "c", times(shape(k), size[k]),
                      Field(kPoints, Eigen::Vector3d::Zero())});
    sum += mean_square(causes.back().value_m);
  }
  const PartError found = part_error(path_of(true), causes, 3);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(found.layers[k].share, mean_square(causes[k].value_m) / sum, 1e-12);
    EXPECT_NEAR(found.layers[k].rms_m, std::sqrt(mean_square(causes[k].value_m)), 1e-18);
    EXPECT_EQ(found.layers[k].share_interval.U(found.layers[k].share), 0);
  }
  // The largest error is at the end of the path, where all causes have the same sign.
  double most = 0;
  std::size_t at = 0;
  for (std::size_t p = 0; p < kPoints; ++p) {
    double z = 0;
    for (const PartCause& c : causes) z += c.value_m[p](2);
    if (std::abs(z) > most) {
      most = std::abs(z);
      at = p;
    }
  }
  EXPECT_NEAR(found.max_m, most, 1e-18);
  EXPECT_EQ(found.worst, at);
  EXPECT_LT(found.p95_m, found.max_m);
  // Without normals, the size of an error is its length.
  EXPECT_NEAR(part_error(path_of(false), causes, 3).max_m, most * std::sqrt(1.09), 1e-15);
}

// Two causes of one layer are added with their signs. If the value of a cause is unknown (a
// budget), its expected square is used.
TEST(PartError, AddsSignedCausesAndExpectedSquares) {
  std::vector<PartCause> causes = {{0, "a", times(shape(1), 3e-6), times(shape(1), 0)},
                                   {0, "b", times(shape(1), -1e-6), times(shape(1), 0)},
                                   {1, "source", times(shape(1), 0), times(shape(1), 2e-6)}};
  const PartError found = part_error(path_of(true), causes, 2);
  EXPECT_NEAR(found.layers[0].rms_m, 2e-6, 1e-15);
  EXPECT_NEAR(found.layers[1].rms_m, 2e-6, 1e-15);
  EXPECT_NEAR(found.layers[0].share, 0.5, 1e-12);
  EXPECT_NEAR(found.causes[0].share, 9. / 14, 1e-12);
  // For a standard normal xi, |2 + 2 xi| (um) is below 0.103 in 2.5 % of the trials (the density
  // at -1 is 0.242), and above 5.92 in 2.5 %.
  EXPECT_NEAR(found.max_interval_m.low, 0.103e-6, 0.08e-6);
  EXPECT_NEAR(found.max_interval_m.high, 5.92e-6, 0.35e-6);
}

// The only cause has a u that is a share of its value. All sizes are proportional to |1 + share
// xi|, so U of each size is the share times the 95 % point of |xi|, 1.96.
TEST(PartError, UncertaintyOfOneCauseMatchesTheClosedForm) {
  const double share = 0.1;
  const std::vector<PartCause> causes = {
      {0, "wave", times(shape(2), 2e-6), times(shape(2), share * 2e-6)}};
  for (const bool with_normals : {true, false}) {
    const PartError found =
        part_error(path_of(with_normals), causes, 1, {.seed = 3, .shares = 4000, .errors = 4000});
    EXPECT_NEAR(found.p95_interval_m.U(found.p95_m) / found.p95_m, 1.96 * share, 0.01);
    EXPECT_NEAR(found.max_interval_m.U(found.max_m) / found.max_m, 1.96 * share, 0.01);
    EXPECT_NEAR(found.layers[0].rms_interval_m.U(found.layers[0].rms_m) / found.layers[0].rms_m,
                1.96 * share, 0.01);
    EXPECT_NEAR(found.causes[0].rms_interval_m.U(found.causes[0].rms_m) / found.causes[0].rms_m,
                1.96 * share, 0.01);
    EXPECT_EQ(found.layers[0].share, 1);
    EXPECT_NEAR(found.layers[0].share_interval.U(found.layers[0].share), 0, 1e-12);
    // Expected: the 191st of 200 sorted sizes.
    std::vector<double> sizes;
    for (const Eigen::Vector3d& v : causes[0].value_m)
      sizes.push_back(with_normals ? std::abs(v(2)) : v.norm());
    std::sort(sizes.begin(), sizes.end());
    EXPECT_NEAR(found.p95_m, sizes[190], 0.005 * sizes[190]);  // median of 4,000 draws
  }
}

// Only u of the cause is known, so the error is not 0 at any point.
TEST(PartError, IsNotZeroIfOnlyUIsKnown) {
  const std::vector<PartCause> causes = {{0, "screw", times(shape(2), 0), times(shape(2), 2e-6)}};
  const PartError found =
      part_error(path_of(true), causes, 1, {.seed = 3, .shares = 100, .errors = 4000});
  double largest = 0;
  for (const Eigen::Vector3d& u : causes[0].u_m) largest = std::max(largest, std::abs(u(2)));
  // The median of |xi| is 0.6745.
  EXPECT_NEAR(found.max_m / largest, 0.6745, 0.03);
  EXPECT_GT(found.p95_m, 0.5 * found.max_m);
  EXPECT_GT(found.max_interval_m.U(found.max_m) / largest, 1.0);
}

// The value of the cause is unknown, so its RMS is |xi| u: below 0.0313 u in 2.5 % of all trials,
// and above 2.2414 u in 2.5 %.
TEST(PartError, RmsOfAnUnknownCauseIsUncertain) {
  const std::vector<PartCause> causes = {{0, "screw", times(shape(2), 0), times(shape(2), 2e-6)}};
  const PartError found =
      part_error(path_of(true), causes, 1, {.seed = 3, .shares = 4000, .errors = 0});
  for (const PartShare& share : {found.layers[0], found.causes[0]}) {
    EXPECT_NEAR(share.rms_interval_m.low / share.rms_m, 0.0313, 0.01);
    EXPECT_NEAR(share.rms_interval_m.high / share.rms_m, 2.2414, 0.06);
  }
}

// A cause of u near zero: its share and RMS are 0 or more, and the other share is 1 or less.
TEST(PartError, IntervalsContainOnlyPossibleValues) {
  const std::vector<PartCause> causes = {
      {0, "a", times(shape(1), 1e-6), times(shape(1), 0.1e-6)},
      {1, "b", times(shape(2), 0.05e-6), times(shape(2), 0.1e-6)}};
  const PartError found = part_error(path_of(true), causes, 2);
  EXPECT_EQ(found.layers[1].share_interval.low, 0);
  EXPECT_EQ(found.layers[1].rms_interval_m.low, 0);
  EXPECT_EQ(found.layers[0].share_interval.high, 1);
  // |v| + 1.96 u
  EXPECT_NEAR(found.layers[1].rms_interval_m.high / found.layers[1].rms_m, 1 + 1.96 * 2, 0.15);
}

// Three measured causes of one layer, perpendicular to each other along the path: sizes 3, 0 and 0,
// each with u = 1 (um RMS) and an error of 1. The measured square is 11. If the true square
// is 8.956, half of all measured squares are below 11 (noncentral chi-square, 3 degrees of
// freedom).
TEST(PartError, ErrorsOfMeasuredValuesDoNotIncreaseTheRms) {
  const auto wave = [](int turns) {
    Field field;
    for (std::size_t p = 0; p < kPoints; ++p)
      field.emplace_back(
          0, 0,
          std::sqrt(2) * std::sin(2 * 3.14159265358979 * turns * static_cast<double>(p) / kPoints));
    return field;
  };
  std::vector<PartCause> causes;
  for (int k = 0; k < 3; ++k)
    causes.push_back({0, "c", times(wave(k + 1), k == 0 ? 3e-6 : 1e-6), times(wave(k + 1), 1e-6)});
  const PartError found =
      part_error(path_of(true), causes, 1, {.seed = 1, .shares = 20'000, .errors = 0});
  EXPECT_NEAR(found.layers[0].rms_m, std::sqrt(8.956) * 1e-6, 0.03e-6);
  EXPECT_NEAR(found.causes[0].rms_m, 3e-6, 1e-11);
  EXPECT_NEAR(found.causes[1].rms_m, 1e-6, 1e-11);
}

// Two causes have the same mean square, and the first has the relative uncertainty r. The share of
// the first is (1 + r xi)² / ((1 + r xi)² + 1); to first order it changes by r xi / 2.
TEST(PartError, UncertaintyOfAShareMatchesTheClosedForm) {
  const double share = 0.02;
  const std::vector<PartCause> causes = {
      {0, "a", times(shape(1), 1e-6), times(shape(1), share * 1e-6)},
      {1, "b", times(shape(1), 1e-6), times(shape(1), 0)}};
  const PartError found =
      part_error(path_of(true), causes, 2, {.seed = 4, .shares = 4000, .errors = 10});
  for (const auto* shares : {&found.layers, &found.causes})
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_NEAR((*shares)[k].share, 0.5, 1e-12);
      EXPECT_NEAR((*shares)[k].share_interval.U((*shares)[k].share), 1.96 * share / 2, 0.001);
    }
  EXPECT_NEAR(found.layers[0].rms_interval_m.U(found.layers[0].rms_m), 1.96 * share * 1e-6,
              0.002e-6);
  EXPECT_EQ(found.layers[1].rms_interval_m.U(found.layers[1].rms_m), 0);
}

// A source acts on an angle. The error is its random number times the lever arm, so it is largest
// at the end of the path in every trial.
TEST(PartError, LargestErrorOfABudgetIsAtTheLongestArm) {
  PartPath path;
  PartCause source = new_cause("source", 101);
  for (std::size_t k = 0; k <= 100; ++k) {
    path.at_m.emplace_back(1e-3 * static_cast<double>(k), 0, 0);
    source.u_m[k] = {5e-6 * (0.05 + path.at_m[k](0)), 0, 5e-6 * 0.1};
  }
  EXPECT_EQ(part_error(path, {source}, 1).worst, 100u);
  // A measured cause that is largest at the other end, with a small u.
  PartCause measured = new_cause("measured", 101);
  for (std::size_t k = 0; k <= 100; ++k)
    measured.value_m[k] = {2e-6 * (1 - 0.01 * static_cast<double>(k)), 0, 0};
  EXPECT_EQ(part_error(path, {source, measured}, 1).worst, 0u);
  path.normal.assign(101, {0, 0, 1});  // the measured error is perpendicular to the normals
  for (std::size_t k = 0; k <= 100; ++k) source.u_m[k](2) = k == 40 ? 2e-6 : 1e-6;
  EXPECT_EQ(part_error(path, {source, measured}, 1).worst, 40u);
}

}  // namespace
}  // namespace mdof::algo
