// Two set-ups of a square. The results are calculated by hand.
#include "algo/separation/square_reversal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace mdof::algo {
namespace {

SquareSetUp set_up(int corner, double value_urad, double u_random_urad, double declared_urad,
                   double freedom) {
  Budget budget;
  budget.value = 1e-6 * value_urad;
  budget.u_random = 1e-6 * u_random_urad;
  budget.u = 1e-6 * std::hypot(u_random_urad, declared_urad);
  budget.freedom = freedom;
  return {corner, budget};
}

// m is the error of the machine, α of the square: m + α = 12 µrad and m - α = 4 µrad, so m = 8
// µrad, α = 4 µrad.
TEST(SquareReversalByHand, SeparatesTheSquareFromTheMachine) {
  const auto found = square_reversal(set_up(1, 12, 3, 2, 10), set_up(-1, 4, 4, 2, 10)).value();
  EXPECT_NEAR(found.EC0Y_rad, 8e-6, 1e-15);
  EXPECT_NEAR(found.square_rad, -4e-6, 1e-15);  // -α, because EC0Y = 12 µrad + square
  EXPECT_NEAR(found.u_random_rad, 2.5e-6, 1e-15);
  EXPECT_NEAR(found.u_declared_rad, 2e-6, 1e-12);
  EXPECT_NEAR(found.u_rad, std::hypot(2.5e-6, 2e-6), 1e-12);
  const auto turned = square_reversal(set_up(-1, 12, 3, 2, 10), set_up(1, 4, 4, 2, 10)).value();
  EXPECT_NEAR(turned.square_rad, 4e-6, 1e-15);
}

// Equation of Welch and Satterthwaite for two equal contributions with 5 degrees of freedom each:
// 10 degrees of freedom. The coverage factor of the t distribution is 2.228.
TEST(SquareReversalByHand, DegreesOfFreedomAdd) {
  const auto found = square_reversal(set_up(1, 1, 3, 0, 5), set_up(-1, 1, 3, 0, 5)).value();
  EXPECT_NEAR(found.freedom, 10, 1e-9);
  EXPECT_NEAR(found.coverage_factor, 2.228, 5e-4);
  EXPECT_NEAR(found.U_rad, found.coverage_factor * found.u_rad, 1e-18);
  const auto uneven = square_reversal(set_up(1, 1, 6, 0, 5), set_up(-1, 1, 3, 0, 20)).value();
  EXPECT_NEAR(uneven.freedom, 45. * 45 / (36. * 36 / 5 + 81. / 20), 1e-9);
}

// u exceeds u_random by one rounding step only, and the repeatability is 1e-13 of u. This must not
// be taken as a declared contribution, and the degrees of freedom are infinite.
TEST(SquareReversalByHand, IgnoresRounding) {
  SquareSetUp a = set_up(1, 1, 3, 0, 5e52), b = set_up(-1, 1, 3, 0, 5e52);
  a.budget.u = std::nextafter(a.budget.u_random, 1);
  const auto found = square_reversal(a, b).value();
  EXPECT_EQ(found.u_declared_rad, 0);
  EXPECT_TRUE(std::isinf(found.freedom));
  EXPECT_NEAR(found.coverage_factor, 1.960, 1e-3);
}

TEST(SquareReversalByHand, RejectsCornersWithoutReversal) {
  EXPECT_NE(square_reversal(set_up(0, 1, 1, 1, 5), set_up(1, 1, 1, 1, 5))
                .error()
                .message.find("the first set-up"),
            std::string::npos);
  EXPECT_NE(square_reversal(set_up(1, 1, 1, 1, 5), set_up(0, 1, 1, 1, 5))
                .error()
                .message.find("the second set-up"),
            std::string::npos);
  EXPECT_NE(square_reversal(set_up(1, 1, 1, 1, 5), set_up(1, 1, 1, 1, 5))
                .error()
                .message.find("with the same sign"),
            std::string::npos);
}

TEST(SquareReversalByHand, ReportsTheAnglesOfBothSetUpsAndTheMeanOfTheirDeclaredU) {
  const auto found = square_reversal(set_up(1, 12, 3, 2, 10), set_up(-1, 4, 4, 1, 10)).value();
  EXPECT_NEAR(found.first_rad, 12e-6, 1e-18);
  EXPECT_NEAR(found.second_rad, 4e-6, 1e-18);
  EXPECT_NEAR(found.u_declared_rad, 1.5e-6, 1e-12);
}

// Found: α = -25 µrad with u = 4 µrad. With a declared u of 3 µrad, u of the difference is 5 µrad,
// so the limit of the difference is 15 µrad.
TEST(SquareReversalByHand, ReportsAnglesThatContradictTheRigs) {
  const auto found = square_reversal(set_up(1, 90, 0, 4, 10), set_up(-1, 40, 0, 4, 10)).value();
  ASSERT_NEAR(found.square_rad, -25e-6, 1e-15);
  ASSERT_NEAR(found.u_rad, 4e-6, 1e-12);
  const auto codes = [&found](const std::vector<std::optional<double>>& declared_urad) {
    std::vector<Rig> rigs(declared_urad.size());
    std::vector<const Rig*> all;
    for (std::size_t i = 0; i < rigs.size(); ++i) {
      if (declared_urad[i]) rigs[i].artefact_angle_error_rad = 1e-6 * *declared_urad[i];
      rigs[i].u_artefact_angle_rad = 3e-6;
      all.push_back(&rigs[i]);
    }
    std::string text;
    for (const Notice& each : square_notices(found, all))
      text += each.code == NoticeCode::square_contradicts_rig ? "contradicts " : "different ";
    return text;
  };
  EXPECT_EQ(codes({std::nullopt, std::nullopt, std::nullopt, std::nullopt}), "");
  EXPECT_EQ(codes({-39.9, std::nullopt, -39.9, -39.9}), "");
  EXPECT_EQ(codes({-40.1, -40.1, -40.1, -40.1}), "contradicts ");
  EXPECT_EQ(codes({-9.9, -9.9, std::nullopt, std::nullopt}), "contradicts ");
  EXPECT_EQ(codes({-25.0, -25.0, -24.0, -24.0}), "different ");
  EXPECT_EQ(codes({-25.0, -25.0, 40.0, 40.0}), "contradicts different ");
  EXPECT_EQ(codes({25.0, std::nullopt, std::nullopt, std::nullopt}), "contradicts ");
  Rig without_u;
  without_u.artefact_angle_error_rad = -38e-6;
  EXPECT_EQ(square_notices(found, {&without_u}).size(), 1U);
}

TEST(SquareReversalByHand, IsNoiseOnlyIfBothSetUpsAre) {
  SquareSetUp first = set_up(1, 12, 3, 2, 10), second = set_up(-1, 4, 4, 1, 10);
  EXPECT_FALSE(square_reversal(first, second)->noise_only);
  first.budget.noise_only = true;
  EXPECT_FALSE(square_reversal(first, second)->noise_only);
  second.budget.noise_only = true;
  EXPECT_TRUE(square_reversal(first, second)->noise_only);
}

}  // namespace
}  // namespace mdof::algo
