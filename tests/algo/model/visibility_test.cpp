#include "algo/model/visibility.h"

#include <gtest/gtest.h>

#include <Eigen/SVD>

#include "tests/algo/rigs.h"

namespace mdof::algo {
namespace {

Fixture paper_fixture() {
  return make_fixture(test::rig_x()).value();
}

// Calculated by hand at a travel of 5 mm: n·δ/(n·u) for displacements δ, lever × n/(n·u) for
// angles; n is the normal of the plane, u the direction of the probe. The second probe is not used.
TEST(Visibility, FirstOrderJacobianByHand) {
  const Fixture fixture{Axis::x,
                        {{"P", {12e-3, 3e-3, 7e-3}, {0.6, 0, 0.8}, {0, 0, 1}, 0, {}, {}},
                         {"Q", {1e-3, 2e-3, 3e-3}, {0, 1, 0}, {0, 1, 0}, 0, {}, {}},
                         {"R", {2e-3, -4e-3, 9e-3}, {0, 0, 1}, {0, 0.6, 0.8}, 0, {}, {}}}};
  Eigen::MatrixXd expected(2, 5);
  expected << 0, 1.25, 3.75e-3, -8.75e-3, 0,  //
      0.75, 1, -10.75e-3, 3e-3, -2.25e-3;
  const Eigen::MatrixXd J = first_order_jacobian(fixture, 5e-3, {true, false, true});
  ASSERT_EQ(J.rows(), 2);
  EXPECT_LT((J - expected).cwiseAbs().maxCoeff(), 1e-15);
}

// Jacobian of the five probes of the paper at a travel of 17.3 mm; the levers are in units of 10
// mm.
TEST(Visibility, ConditionScalesAnglesByTenMillimetres) {
  Eigen::Matrix<double, 5, 5> J;
  J << 0, 1, 0, 0.73, 0,   //
      0, 1, 1, 1.73, 0,    //
      0, 1, -1, 1.73, 0,   //
      1, 0, -2, 0, -1.73,  //
      1, 0, -2, 0, -0.73;
  const Eigen::VectorXd singular = J.jacobiSvd().singularValues();
  const Visibility seen = visibility(paper_fixture(), std::vector<bool>(5, true));
  EXPECT_EQ(seen.rank, 5);
  EXPECT_TRUE(seen.complete());
  EXPECT_TRUE(seen.unseen.empty());
  EXPECT_NEAR(seen.condition, singular(0) / singular(4), 1e-9);
}

// Without E the probes cannot separate EYX and ECX. Without B they cannot detect the combination of
// εx = εy with the δy and δz that compensate it.
TEST(Visibility, NamesTheErrorsOfUnseenCombinations) {
  using Names = std::vector<std::string>;
  const Fixture fixture = paper_fixture();
  const Visibility without_e = visibility(fixture, {true, true, true, true, false});
  EXPECT_EQ(without_e.rank, 4);
  EXPECT_FALSE(without_e.complete());
  EXPECT_EQ(without_e.unseen, (Names{"EYX", "ECX"}));
  EXPECT_EQ(visibility(fixture, {true, false, true, true, true}).unseen,
            (Names{"EYX", "EZX", "EAX", "EBX"}));
  const Visibility top = visibility(fixture, {true, true, true, false, false});
  EXPECT_EQ(top.rank, 3);
  EXPECT_EQ(top.unseen, (Names{"EYX", "ECX"}));
  const Visibility none = visibility(fixture, std::vector<bool>(5, false));
  EXPECT_EQ(none.rank, 0);
  EXPECT_EQ(none.unseen, (Names{"EYX", "EZX", "EAX", "EBX", "ECX"}));
}

TEST(Visibility, DescribesTheProbesAndUnseenErrors) {
  const Fixture fixture = paper_fixture();
  const auto text = [&](std::vector<std::string> unseen) {
    return describe_unseen(fixture, {false, true, false, true, true}, {3, 0, std::move(unseen)});
  };
  EXPECT_EQ(text({"ECX"}).find(
                "probes B D E cannot measure ECX (their readings determine 3 of 5 unknowns)"),
            0u);
  EXPECT_EQ(text({"EYX", "ECX"}).find("probes B D E cannot separate EYX and ECX (their readings"),
            0u);
  EXPECT_EQ(text({"EYX", "EZX", "ECX"})
                .find("probes B D E cannot separate EYX, EZX and ECX (their readings"),
            0u);
  EXPECT_EQ(describe_unseen(fixture, std::vector<bool>(5, false), {5, 0, {"EYX"}}),
            "no probe has a usable reading; five probes are needed");
}

}  // namespace
}  // namespace mdof::algo
