#include "algo/model/solver.h"

#include <gtest/gtest.h>

#include <cmath>

#include "algo/model/rigid.h"
#include "tests/algo/rigs.h"

namespace mdof::algo {
namespace {

TEST(Solver, NamesTheErrorsThatFourProbesCannotSee) {
  Rig rig = test::rig_x();
  rig.probes.pop_back();  // without E, yaw and horizontal straightness cannot be separated
  const auto refused = Solver::create(rig, Model::rigid);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::bad_input);
  for (const char* word : {"A B C D", "ECX", "EYX", "rig_X.toml"}) {
    EXPECT_NE(refused.error().message.find(word), std::string::npos) << refused.error().message;
  }
  EXPECT_EQ(refused.error().message.find("EZX"), std::string::npos);
  EXPECT_NE(refused.error().message.find(
                "probes A B C D cannot separate EYX and ECX (their readings determine 4"),
            std::string::npos)
      << refused.error().message;
}

TEST(Solver, NamesTheErrorsThatOnePlaneCannotSee) {
  Rig rig = test::rig_x();
  for (std::size_t i : {3u, 4u}) {
    rig.probes[i].direction = {0, 0, 1};
    rig.probes[i].position_m = {-0.01, i == 3 ? 0.005 : -0.005, 0};
  }
  const auto refused = Solver::create(rig, Model::rigid);
  ASSERT_FALSE(refused);
  for (const char* word : {"EYX", "ECX", "determine 3"}) {
    EXPECT_NE(refused.error().message.find(word), std::string::npos) << refused.error().message;
  }
}

TEST(Solver, SmallAngleModelsNameTheModelForOtherRigs) {
  const auto refused = Solver::create(test::rig_oblique(), Model::exact);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("use the model \"rigid\""), std::string::npos);
}

TEST(Solver, LostProbeLeavesThePointUnsolvedWithReason) {
  const Solver solver = Solver::create(test::rig_x(), Model::exact).value();
  const AxisErrors got = solver.solve(0, {0, 0, 0, std::nan(""), 0}, {});
  EXPECT_FALSE(got.valid);
  EXPECT_NE(got.reason.find("EYX"), std::string::npos) << got.reason;
}

TEST(Solver, SevenProbesTolerateTheLossOfOne) {
  const Solver solver = Solver::create(test::rig_oblique(), Model::rigid).value();
  const Errors5 e{3e-6, 4e-6, 2e-4, 1e-4, -2e-4};
  const Eigen::VectorXd m = rigid_readings(solver.fixture(), 0.02, e);
  std::vector<double> readings(m.data(), m.data() + m.size());
  readings[4] = std::nan("");
  const AxisErrors got = solver.solve(0.02, readings, {});
  ASSERT_TRUE(got.valid) << got.reason;
  for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(got.local[k], e[k], 1e-13);
}

}  // namespace
}  // namespace mdof::algo
