// Tests the unknowns of probes in any direction, and the derivatives of their readings.
#include "algo/calibration/mounting_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "tests/algo/rigs.h"

namespace mdof::algo {
namespace {

// Clampings with three tilts. Each clamping has traverses along X and Y.
std::vector<Clamping> simulated_clampings(std::size_t probes) {
  std::vector<Clamping> clampings;
  for (int c = 0; c < 3; ++c) {
    Clamping clamping;
    for (const Axis axis : {Axis::x, Axis::y}) {
      Traverse traverse{axis, {}};
      for (int i = 0; i < 4; ++i) {
        TraverseStop stop{1e-3 * (i - 1.5), {}, std::vector<double>(probes, 1e-8)};
        for (std::size_t k = 0; k < probes; ++k)
          stop.reading_m.push_back(1e-6 * std::sin(static_cast<double>(k + 1) * (i + 2 * c + 1)));
        traverse.stops.push_back(stop);
      }
      clamping.traverses.push_back(traverse);
    }
    clampings.push_back(clamping);
  }
  return clampings;
}

TEST(MountingModel, UnknownsAreAlongOrthogonalUnitVectors) {
  const Rig rig = test::rig_oblique();
  const auto model = MountingModel::create(rig, simulated_clampings(7));
  ASSERT_TRUE(model) << model.error().message;
  for (std::size_t k = 0; k < 7; ++k) {
    const FixtureProbe& probe = model->nominal().probes[k];
    for (const auto& [two, across] :
         {std::pair(std::array{model->along(k, 0), model->along(k, 1)}, probe.n_C),
          std::pair(std::array{model->towards(k, 0), model->towards(k, 1)}, probe.u_M)}) {
      EXPECT_NEAR(two[0].norm(), 1, 1e-12) << k;
      EXPECT_NEAR(two[1].norm(), 1, 1e-12) << k;
      EXPECT_NEAR(two[0].dot(two[1]), 0, 1e-12) << k;
      EXPECT_NEAR(two[0].dot(across), 0, 1e-12) << k;
      EXPECT_NEAR(two[1].dot(across), 0, 1e-12) << k;
    }
    const Eigen::Vector3d turned = model->rotated_direction(k, 3e-3, -4e-3);
    EXPECT_NEAR(turned.norm(), 1, 1e-12);
    EXPECT_NEAR(turned.dot(model->towards(k, 0)), 3e-3, 1e-7) << k;
    EXPECT_NEAR(turned.dot(model->towards(k, 1)), -4e-3, 1e-7) << k;
  }
  EXPECT_EQ(model->unknowns(), 7 * kMountingUnknowns);
  EXPECT_EQ(model->pose_unknowns(), 3 * 3 + 2 * 6);
  EXPECT_EQ(model->readings().size(), 3u * 2 * 4 * 7);
}

// Expects that each column equals the central difference of the residuals, at tilts of 20 mrad.
void expect_derivatives(const MountingModel& model) {
  Eigen::VectorXd pose(model.pose_unknowns()), probe(model.unknowns());
  for (Eigen::Index i = 0; i < pose.size(); ++i)
    pose(i) = i < 9 ? 2 * std::sin(2.0 * static_cast<double>(i) + 1)
                    : 1e-5 * std::cos(static_cast<double>(i));
  for (Eigen::Index i = 0; i < probe.size(); ++i)
    probe(i) = 0.5 * std::cos(1.7 * static_cast<double>(i));
  const auto at = model.linearised(pose, probe);
  // The residual is the reading minus the reading of the model, so the difference has the opposite
  // sign.
  const auto compare = [&](const Eigen::VectorXd& column, const Eigen::VectorXd& above,
                           const Eigen::VectorXd& below, double step, Eigen::Index i) {
    const Eigen::VectorXd slope = (below - above) / (2 * step);
    EXPECT_GT(column.norm(), 0) << i;
    EXPECT_LT((slope - column).norm(), 2e-3 * column.norm() + 1e-3) << i;
  };
  for (Eigen::Index i = 0; i < pose.size(); ++i) {
    const double step = i < 9 ? 1e-3 : 1e-8;
    Eigen::VectorXd above = pose, below = pose;
    above(i) += step;
    below(i) -= step;
    compare(at.by_pose.col(i), model.linearised(above, probe).misfit,
            model.linearised(below, probe).misfit, step, i);
  }
  for (Eigen::Index i = 0; i < probe.size(); ++i) {
    if (model.scale()(i) == 0) continue;
    Eigen::VectorXd above = probe, below = probe;
    above(i) += 1e-3;
    below(i) -= 1e-3;
    compare(at.by_probe.col(i), model.linearised(pose, above).misfit,
            model.linearised(pose, below).misfit, 1e-3, i);
  }
}

TEST(MountingModel, DerivativesMatchFiniteDifferences) {
  expect_derivatives(MountingModel::create(test::rig_oblique(), simulated_clampings(7)).value());
  const Rig rig = test::rig_x_with("B", "u_sensitivity_ppm = 1000");
  const auto model = MountingModel::create(rig, simulated_clampings(5)).value();
  EXPECT_NEAR(model.scale()(unknown_of(1, algo::kScale)), 1e-3, 1e-15);
  EXPECT_EQ(model.scale()(unknown_of(0, algo::kScale)), 0);
  expect_derivatives(model);
}

// The rig declares the uncertainty of a position along the machine axes. An unknown whose
// uncertainty the rig does not declare has the prior uncertainty of mounting by hand.
TEST(MountingModel, PriorUncertaintiesComeFromTheRigOrDefaults) {
  const Rig rig = test::rig_x_with(
      "D", "u_position_mm = [0.02, 0.03, 0.04]\nu_direction_mrad = 7\nu_sensitivity_ppm = 300");
  const auto model = MountingModel::create(rig, simulated_clampings(5)).value();
  // D faces the side plane: its position unknowns are along X and Z.
  for (const auto& [which, axis, u] :
       {std::tuple(kPlace1, 0, 0.02e-3), std::tuple(kPlace2, 2, 0.04e-3)}) {
    EXPECT_NEAR(std::abs(model.along(3, which == kPlace1 ? 0 : 1)(axis)), 1, 1e-12);
    EXPECT_NEAR(model.scale()(unknown_of(3, which)), u, 1e-12);
    EXPECT_TRUE(model.declared(unknown_of(3, which)));
    EXPECT_NEAR(model.scale()(unknown_of(0, which)), 50e-6, 1e-12);
    EXPECT_FALSE(model.declared(unknown_of(0, which)));
  }
  for (const auto which : {kTowards1, kTowards2}) {
    EXPECT_NEAR(model.scale()(unknown_of(3, which)), 7e-3, 1e-12);
    EXPECT_NEAR(model.scale()(unknown_of(0, which)), 2e-3, 1e-12);
  }
  EXPECT_NEAR(model.scale()(unknown_of(3, algo::kScale)), 300e-6, 1e-12);
  EXPECT_NEAR(model.scale()(unknown_of(3, kZero)), 100e-6, 1e-12);  // half of the range
  EXPECT_FALSE(model.declared(unknown_of(3, kZero)));
}

// If a plane is tilted by t, the encoder uncertainty u contributes t u to a reading.
TEST(MountingModel, EncoderUncertaintyEntersThroughTilts) {
  auto model = MountingModel::create(test::rig_x(), simulated_clampings(5)).value();
  Eigen::VectorXd pose = Eigen::VectorXd::Zero(model.pose_unknowns());
  pose(3 + 1) = 2;  // the second clamping is pitched by 20 mrad
  EXPECT_NEAR(model.clamping_angles(pose, 1)[kEy], 0.02, 1e-15);
  EXPECT_EQ(model.clamping_angles(pose, 0), Errors5{});
  model.add_encoder_uncertainty(pose, 1e-6);
  for (const TraverseReading& seen : model.readings()) {
    const bool is_pitched = seen.clamping == 1 && seen.probe < 3 && seen.traverse % 2 == 0;
    // Travel along Y towards the side plane.
    const bool is_driven_into = seen.probe >= 3 && seen.traverse % 2 == 1;
    const double by_encoder = is_pitched ? 0.02e-6 : is_driven_into ? 1e-6 : 0;
    EXPECT_NEAR(seen.u_m, std::hypot(1e-8, by_encoder), 1e-3 * by_encoder + 1e-15)
        << seen.clamping << ' ' << seen.traverse << ' ' << seen.probe;
  }
}

}  // namespace
}  // namespace mdof::algo
