// Tests decisions about a figure with a tolerance, by ISO 14253-1:2017.
#include "algo/uncertainty/conformity/decision.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace mdof::algo {
namespace {

Budget budget_of(double value, double u = 0.1) {
  Budget budget;
  budget.value = value;
  budget.u = u;
  budget.freedom = std::numeric_limits<double>::infinity();
  budget.coverage_factor = 1.959964;
  budget.U = budget.coverage_factor * u;
  return budget;
}

Conformity said_of(double value) {
  return decision(budget_of(value), 1.0).conformity;
}

// The guard band is g = 1.645 · 0.1, not U = 0.196.
TEST(Decision, UsesTheOneSidedGuardBand) {
  EXPECT_EQ(said_of(0.835), Conformity::conform);
  EXPECT_EQ(said_of(-0.835), Conformity::conform);
  EXPECT_EQ(said_of(0.836), Conformity::undecided);
  EXPECT_EQ(said_of(1.164), Conformity::undecided);
  EXPECT_EQ(said_of(1.165), Conformity::not_conform);
  EXPECT_EQ(said_of(-1.165), Conformity::not_conform);
  EXPECT_EQ(said_of(std::nan("")), Conformity::undecided);
  const Decision d = decision(budget_of(0.9), 1.0);
  EXPECT_NEAR(d.guard_band, 0.16448536, 1e-8);
  EXPECT_EQ(d.rule,
            "ISO 14253-1:2017, 95 % conformance probability, one-sided, guard band g = 1.645 u");
  EXPECT_NE(d.reason.find("within the guard band"), std::string::npos);
}

// A value that does not conform to a tolerance must not conform to a smaller tolerance. With u =
// 0.1, the guard band is two-sided for tolerances below 0.24.
TEST(Decision, IsMonotoneInTheTolerance) {
  for (double limit = 0.4; limit > 0.001; limit -= 0.001)
    EXPECT_EQ(decision(budget_of(0.57), limit).conformity, Conformity::not_conform) << limit;
}

// The measured value is the largest that is accepted. The true values are drawn about it; at least
// 95 % of them must be within the tolerance.
TEST(Decision, IsCorrectWithTheStatedProbability) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> noise(0, 0.1);
  for (const double limit : {1.0, 0.2}) {  // for 0.2 a value may exceed either end of the tolerance
    double edge = limit;
    while (edge > 0 && decision(budget_of(edge), limit).conformity != Conformity::conform)
      edge -= 1e-4;
    int within = 0;
    constexpr int kDraws = 40'000;
    for (int i = 0; i < kDraws; ++i) within += std::abs(edge + noise(random)) <= limit ? 1 : 0;
    // With a one-sided guard band this would be 0.90 for 0.2.
    const double share = static_cast<double>(within) / kDraws;
    EXPECT_NEAR(share, 0.953, 0.007) << limit;
  }
}

TEST(Decision, IsUndecidedForAnIncompleteU) {
  for (const double value : {0.0, 5.0}) {
    Budget budget = budget_of(value);
    budget.not_declared = {"u_flatness_um", "u_um_per_h"};
    const Decision d = decision(budget, 1.0);
    EXPECT_EQ(d.conformity, Conformity::undecided);
    EXPECT_EQ(d.reason, "U is incomplete: the rig does not declare u_flatness_um and u_um_per_h");
  }
}

TEST(Decision, UsesUForRangesAndStudentsTForFewDegrees) {
  Budget range = budget_of(0.85);
  range.U_by_trials = true;
  EXPECT_EQ(decision(range, 1.0).conformity, Conformity::undecided);
  EXPECT_NEAR(decision(range, 1.0).guard_band, range.U, 1e-15);
  Budget few = budget_of(0.83);
  few.freedom = 5;
  EXPECT_NEAR(decision(few, 1.0).guard_factor, 2.015048, 1e-6);
  EXPECT_EQ(decision(few, 1.0).conformity, Conformity::undecided);
}

TEST(Decision, ContainsTheLimit) {
  EXPECT_EQ(decision(budget_of(0.5), 1.25).limit, 1.25);
}

// If u is 0 or unknown, the decision is "undecided".
TEST(Decision, IsUndecidedWithoutU) {
  for (const double u : {0.0, std::nan("")}) {
    Budget budget = budget_of(0.5);
    budget.u = budget.U = u;
    const Decision d = decision(budget, 1.0);
    EXPECT_EQ(d.conformity, Conformity::undecided);
    EXPECT_NE(d.reason.find(u == 0 ? "u is 0" : "unknown"), std::string::npos);
    EXPECT_TRUE(std::isnan(d.guard_band));
  }
}

TEST(Decision, IsUndecidedForPartialAndSingleRuns) {
  EXPECT_EQ(decision(budget_of(0.1), 1.0, "run 3 is partial").reason, "run 3 is partial");
  EXPECT_EQ(decision(budget_of(0.1), 1.0, "run 3 is partial").conformity, Conformity::undecided);
  Budget once = budget_of(0.1);
  once.is_single_run = true;
  EXPECT_EQ(decision(once, 1.0).conformity, Conformity::undecided);
}

}  // namespace
}  // namespace mdof::algo
