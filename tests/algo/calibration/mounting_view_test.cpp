// Tests the sentences about combinations of unknowns that the clampings do not determine. The tests
// give the combinations.
#include "algo/calibration/mounting_view.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/algo/rigs.h"

namespace mdof::algo {
namespace {

// A, B and C face one plane, D and E face another. The position of each probe has u = 20 um.
MountingModel two_plane_model() {
  Rig rig = test::rig_x_with("D", "u_sensitivity_ppm = 300");
  for (Probe& probe : rig.probes) probe.uncertainty.position.u = {20e-6, 20e-6, 20e-6};
  return MountingModel::create(rig, {}).value();
}

// Sentences if only these combinations of unknowns (vectors in units of scale()) are not
// determined.
Unseen named(const MountingModel& model, const std::vector<Eigen::VectorXd>& directions) {
  MountingView view;
  view.unseen = Eigen::MatrixXd(model.unknowns(), static_cast<Eigen::Index>(directions.size()));
  for (std::size_t i = 0; i < directions.size(); ++i)
    view.unseen.col(static_cast<Eigen::Index>(i)) = directions[i].normalized();
  return find_unseen(model, view);
}
Eigen::VectorXd unit(const MountingModel& model, std::size_t probe, MountingUnknown which) {
  return Eigen::VectorXd::Unit(model.unknowns(), unknown_of(probe, which));
}
// Combination in which the same unknown of several probes changes by the same amount. A position
// changes along the axis that this unknown has for the first probe.
Eigen::VectorXd together(const MountingModel& model, const std::vector<std::size_t>& probes,
                         MountingUnknown which) {
  const std::size_t j = which == kPlace1 ? 0 : 1;
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(model.unknowns());
  for (const std::size_t k : probes)
    sum += model.along(probes[0], j).dot(model.along(k, j)) * unit(model, k, which);
  return sum;
}

TEST(MountingView, NamesAProbeRelativeToTheOthers) {
  const MountingModel model = two_plane_model();
  const auto sentences = [&](std::size_t probe, MountingUnknown which) {
    const Unseen unseen = named(model, {unit(model, probe, which)});
    EXPECT_EQ(unseen.apart.cols(), 1);
    for (Eigen::Index i = 0; i < model.unknowns(); ++i)
      EXPECT_NEAR(unseen.share(i), i == unknown_of(probe, which) ? 1 : 0, 1e-12);
    EXPECT_EQ(unseen.u_together_m, Vec3{});
    return unseen.sentences;
  };
  using Sentences = std::vector<std::string>;
  EXPECT_EQ(sentences(1, kZero), Sentences{"the zero offset of B relative to the other probes"});
  for (const auto which : {kTowards1, kTowards2})
    EXPECT_EQ(sentences(4, which), Sentences{"the direction of E, because the tilts of the target "
                                             "and the readings of the probe are too small"});
  EXPECT_EQ(sentences(3, algo::kScale),
            Sentences{"the sensitivity of D, because a calibration of the mounting does not "
                      "determine it; calibrate the sensitivity separately"});
  // D measures along Y, so the unknowns of its position are along X and Z.
  for (const auto which : {kPlace1, kPlace2}) {
    const bool is_x = std::abs(model.along(3, which == kPlace1 ? 0 : 1).x()) > 0.5;
    EXPECT_EQ(sentences(3, which),
              Sentences{std::string("the position of D along ") + (is_x ? "X" : "Z") +
                        " relative to the other probes. To determine the position, clamp the "
                        "target at more tilts, with larger differences between the tilts"});
  }
  // The sensitivity of A has no declared u, so it is not an unknown.
  EXPECT_TRUE(named(model, {unit(model, 0, algo::kScale)}).sentences.empty());
}

TEST(MountingView, NamesProbesOfAPlaneTogether) {
  const MountingModel model = two_plane_model();
  const Unseen both =
      named(model, {together(model, {3, 4}, kPlace1), together(model, {3, 4}, kPlace2)});
  // The mean of two positions with u = 20 um each has u = 20 um / sqrt(2).
  ASSERT_EQ(both.sentences.size(), 2u);
  for (const auto& sentence : both.sentences)
    EXPECT_NE(sentence.find("the common position of D, E along "), std::string::npos) << sentence;
  EXPECT_NE(both.sentences[0].find("the u of this mean is 14.1 um"), std::string::npos)
      << both.sentences[0];
  EXPECT_NEAR(both.u_together_m[0], 20e-6 / std::sqrt(2.0), 1e-12);
  EXPECT_EQ(both.u_together_m[1], 0);
  EXPECT_NEAR(both.u_together_m[2], 20e-6 / std::sqrt(2.0), 1e-12);
  EXPECT_EQ(both.apart.cols(), 0);

  const auto zeros =
      Eigen::VectorXd(unit(model, 0, kZero) + unit(model, 1, kZero) + unit(model, 2, kZero));
  const Unseen zero = named(model, {zeros, unit(model, 4, kZero)});
  EXPECT_EQ(zero.sentences,
            (std::vector<std::string>{"the common zero offset of A, B, C. The calibration does not "
                                      "change the mean of offset_um of these probes in the rig",
                                      "the zero offset of E relative to the other probes"}));
  EXPECT_EQ(zero.apart.cols(), 1);
}

// If the rig does not declare u of one position, u of the common mean is unknown.
TEST(MountingView, OneUndeclaredPositionMakesTheMeanUnknown) {
  Rig rig = test::rig_x();
  for (Probe& probe : rig.probes)
    if (probe.id != "B") probe.uncertainty.position.u = {20e-6, 20e-6, 20e-6};
  const MountingModel model = MountingModel::create(rig, {}).value();
  Eigen::VectorXd scaled =
      together(model, {0, 1, 2}, kPlace1).cwiseQuotient(model.scale().cwiseMax(1e-12));
  const Unseen unseen = named(model, {scaled});
  ASSERT_EQ(unseen.sentences.size(), 1u);
  EXPECT_NE(unseen.sentences[0].find("the common position of A, B, C along "), std::string::npos);
  EXPECT_NE(unseen.sentences[0].find("the rig does not declare the u of this mean"),
            std::string::npos);
  const std::size_t axis = std::abs(model.along(0, 0).x()) > 0.5 ? 0 : 1;
  EXPECT_TRUE(std::isnan(unseen.u_together_m[axis]));
  EXPECT_EQ(unseen.u_together_m[2], 0);
}

// Probes with general directions for the axis X, and the same fixture turned for Y. A run along Y
// has the local axes x = +Y and y = -X. The sentence names a position by the machine axis that is
// nearest to its direction.
TEST(MountingView, NamesAPositionByTheNearestMachineAxis) {
  const Rig along_x = test::rig_oblique();
  Rig along_y = along_x;
  along_y.axis = Axis::y;
  const auto turned = [](const Vec3& v) { return Vec3{-v[1], v[0], v[2]}; };
  for (Probe& probe : along_y.probes) {
    probe.position_m = turned(probe.position_m);
    probe.direction = turned(probe.direction);
  }
  for (TargetPlane& plane : along_y.planes) plane.normal = turned(plane.normal);
  int named_places = 0;
  for (Rig rig : {along_x, along_y}) {
    for (Probe& probe : rig.probes) probe.uncertainty.position.u = {20e-6, 20e-6, 20e-6};
    const MountingModel model = MountingModel::create(rig, {}).value();
    for (std::size_t k = 0; k < rig.probes.size(); ++k)
      for (const auto which : {kPlace1, kPlace2}) {
        const Eigen::Vector3d local = model.along(k, which == kPlace1 ? 0 : 1);
        const Eigen::Vector3d machine =
            rig.axis == Axis::x ? local : Eigen::Vector3d(-local.y(), local.x(), local.z());
        Eigen::Index nearest = 0;
        machine.cwiseAbs().maxCoeff(&nearest);
        const Unseen unseen = named(model, {unit(model, k, which)});
        const std::string expected = "the position of " + rig.probes[k].id + " along " +
                                     std::string(1, "XYZ"[nearest]) +
                                     " relative to the other probes";
        ASSERT_EQ(unseen.sentences.size(), 1u) << expected;
        EXPECT_EQ(unseen.sentences[0].substr(0, expected.size()), expected);
        ++named_places;
      }
  }
  EXPECT_EQ(named_places, 2 * 2 * 7);
}

}  // namespace
}  // namespace mdof::algo
