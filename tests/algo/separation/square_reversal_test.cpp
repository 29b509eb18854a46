// Two set-ups of a square. The results are calculated by hand.
#include "algo/separation/square_reversal.h"

#include <gtest/gtest.h>

#include <cmath>

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
