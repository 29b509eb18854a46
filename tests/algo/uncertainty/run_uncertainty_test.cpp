// The uncertainty of the errors of each point, compared with the formulas that
// tests/algo/uncertainty/contributors_test also uses.
#include "algo/uncertainty/run_uncertainty.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "algo/uncertainty/coverage.h"
#include "tests/algo/rigs.h"
#include "tests/algo/uncertainty/synthetic_run.h"

namespace mdof::algo {
namespace {

using test::rig_x_with;

constexpr double kL_m = 0.010, kUp_m = 0.020;
enum { kEYX, kEZX, kEAX, kEBX, kECX };

Run measured(const Rig& rig, double u_reading_m) {
  SyntheticRun synthetic{.rig = rig, .model = Model::simplified};
  synthetic.u_reading_m = u_reading_m;
  return synthetic.measure();
}

Run without_points() {
  return {};
}

TEST(RunUncertainty, IsTheNoiseWithoutDeclarations) {
  const Rig rig = rig_x_with("", "");
  const auto u = run_uncertainty(rig, measured(rig, 10e-9));
  EXPECT_TRUE(u.noise_only);
  EXPECT_EQ(covers_text(u), "noise and repeatability only (no uncertainties are declared)");
  EXPECT_EQ(u.not_declared.size(), 12u);
  ASSERT_EQ(u.points.size(), 54u);
  for (const auto& point : u.points) {
    EXPECT_EQ(point.u, point.u_random);
    EXPECT_NEAR(point.u[kECX], 10e-9 * std::sqrt(2) / kL_m, 1e-12);            // (E - D)/l
    EXPECT_NEAR(point.freedom[kECX], 99, 1e-9);                                // 100 scans
    EXPECT_NEAR(point.U[kECX], 1.984 * point.u[kECX], 0.001 * point.u[kECX]);  // GUM table G.2
  }
}

// EYX = D + l'' (B - C)/2l. The squares of the u of the zero and of the noise add. The degrees of
// freedom follow from GUM equation G.2b.
TEST(RunUncertainty, DeclaredUncertaintiesAddToTheNoise) {
  const double zero = 30e-9, noise = 10e-9;
  const Rig rig = rig_x_with("B", "u_calibration_um = { u = 0.03, dof = 4 }");
  const auto found = run_uncertainty(rig, measured(rig, noise));
  EXPECT_FALSE(found.noise_only);
  EXPECT_EQ(covers_text(found), "noise, repeatability and the declared uncertainties");
  const auto& point = found.points[7];
  const double share = kUp_m / kL_m / 2;
  const double random2 = noise * noise * (1 + 2 * share * share);
  const double declared2 = zero * zero * share * share;
  EXPECT_NEAR(point.u_random[kEYX], std::sqrt(random2), 1e-13);
  EXPECT_NEAR(point.u[kEYX], std::sqrt(random2 + declared2), 1e-13);
  const double freedom = (random2 + declared2) * (random2 + declared2) /
                         (random2 * random2 / 99 + declared2 * declared2 / 4);
  EXPECT_NEAR(point.freedom[kEYX], freedom, 1e-4);
  EXPECT_NEAR(point.U[kEYX], coverage_factor(freedom) * point.u[kEYX], 1e-13);
  EXPECT_EQ(point.u[kECX], point.u_random[kECX]);  // E - D does not depend on B
}

// From pass to pass the level changes by ten times the noise, so the u of each point is the
// standard deviation of the level.
TEST(RunUncertainty, ScatterOfVisitsReplacesSmallerNoise) {
  const Rig rig = rig_x_with("", "");
  const double steps[] = {-1, 3, 2, -2, 1, -3};  // level of D and E in each pass of nine points
  SyntheticRun synthetic{.rig = rig, .model = Model::simplified};
  synthetic.u_reading_m = 10e-9;
  synthetic.added = [&](std::size_t k, double, double, double time_s) {
    return k < 3 ? 0 : 100e-9 * steps[static_cast<int>((time_s - 5) / 90)];
  };
  auto run = synthetic.measure();
  const auto found = run_uncertainty(rig, run);
  // The levels of the forward passes are -1, 2, 1, of the reverse passes 3, -2, -3. The sums of
  // squares about their means are 14/3 and 62/3, with two degrees of freedom each.
  const double sd = 100e-9 * std::sqrt((14.0 + 62) / 3 / 4);
  for (const auto& point : found.points) {
    EXPECT_NEAR(point.u_random[kEYX], sd, 1e-12);
    EXPECT_NEAR(point.freedom[kEYX], 4, 1e-6);  // six passes, two means
    // E - D has no level, so it keeps the u of its noise.
    EXPECT_NEAR(point.freedom[kECX], 99, 1e-6);
  }
  // A stop keeps the u of its noise if this u exceeds the scatter of the visits.
  run.points[5].errors.covariance[6 * kDy] = 1e-12;
  EXPECT_NEAR(run_uncertainty(rig, run).points[5].u_random[kEYX], 1e-6, 1e-12);
  // A single run has no repeated visits, so their scatter is unknown.
  synthetic.runs = 1;
  const auto single = run_uncertainty(rig, synthetic.measure());
  EXPECT_LT(single.points[5].u_random[kEYX], 50e-9);
  EXPECT_EQ(
      covers_text(single),
      "noise only (no uncertainties are declared); noise with periods longer than a stop is not "
      "included (in at least one run, no target was approached twice from the same direction)");
}

// The declared drift explains the differences between the visits, so they do not increase u.
TEST(RunUncertainty, DeclaredDriftDoesNotCountTwice) {
  const Rig rig = rig_x_with("", "", "[drift]\nu_um_per_h = 3\n");
  SyntheticRun synthetic{.rig = rig, .model = Model::simplified};
  synthetic.u_reading_m = 10e-9;
  synthetic.added = [&](std::size_t k, double, double, double time_s) {
    return k == 3 ? 3e-6 / 3600 * time_s : 0;  // D drifts by the declared rate
  };
  for (const auto& point : run_uncertainty(rig, synthetic.measure()).points)
    EXPECT_LT(point.u_random[kEYX], 30e-9);  // the drift between the visits is 150 nm
}

// The drifts of the probes are drawn from the declared distribution. The differences between the
// visits show a large drift of a run, but it does not increase u, because it is declared. A drift
// of twenty times the declared u increases u.
TEST(RunUncertainty, DeclaredDriftCoversADrawnDrift) {
  const Rig rig = rig_x_with("", "", "[drift]\nu_um_per_h = 3\n");
  constexpr double kRate_m_per_s = 3e-6 / 3600, kNoise_m = 10e-9;
  std::mt19937_64 engine(12);
  std::normal_distribution<> normal;
  SyntheticRun synthetic{.rig = rig, .model = Model::simplified};
  synthetic.u_reading_m = kNoise_m;
  std::array<double, 5> rate{};
  synthetic.added = [&](std::size_t k, double, double, double time_s) {
    return rate[k] * (time_s - 10) + kNoise_m * normal(engine);  // the first point is at 10 s
  };
  int inside = 0, all = 0;
  for (int run = 0; run < 1000; ++run) {
    for (double& of_probe : rate) of_probe = kRate_m_per_s * normal(engine);
    const auto measured = synthetic.measure();
    const auto found = run_uncertainty(rig, measured);
    for (const std::size_t j : {5u, 30u, 50u}) {
      const Errors5 error = named_from_local(Axis::x, measured.points[j].errors.local);
      for (std::size_t k = 0; k < 5; ++k) {
        ++all;
        inside += std::abs(error[k]) <= found.points[j].U[k];
      }
    }
  }
  std::printf("points of runs that drift as declared: %.1f %%\n", 100.0 * inside / all);
  EXPECT_NEAR(100.0 * inside / all, 95, 1.5);
  rate.fill(0);
  rate[3] = 20 * kRate_m_per_s;
  const auto found = run_uncertainty(rig, synthetic.measure());
  EXPECT_GT(found.points[50].u_random[kEYX], 1e-6);  // the drift between two runs is 3 µm
}

// The tilts of a probe about two axes are one contributor with four degrees of freedom, not two
// contributors with four each.
TEST(RunUncertainty, PartsOfAContributorShareItsDegreesOfFreedom) {
  const Rig rig = rig_x_with("D", "u_direction_mrad = { u = 2, dof = 4 }");
  SyntheticRun synthetic{.rig = rig, .model = Model::exact};
  synthetic.truth = [](double d) { return Errors5{0, 1e-3 * d, 0, 0, 2e-3 * d}; };
  const auto found = run_uncertainty(rig, synthetic.measure());
  const auto& last = found.points[8];
  EXPECT_GT(last.u[kEYX], 0);
  EXPECT_NEAR(last.freedom[kEYX], 4, 1e-9);
  EXPECT_NEAR(last.U[kEYX], 2.776 * last.u[kEYX], 1e-3 * last.u[kEYX]);  // GUM table G.2
}

TEST(RunUncertainty, PointWithoutErrorsHasNoU) {
  const Rig rig = rig_x_with("B", "u_calibration_um = 0.03");
  auto run = measured(rig, 10e-9);
  run.points[3].errors.valid = false;
  const auto found = run_uncertainty(rig, run);
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_TRUE(std::isnan(found.points[3].u[k]));
    EXPECT_TRUE(std::isnan(found.points[3].U[k]));
    EXPECT_TRUE(std::isfinite(found.points[4].u[k]));
  }
}

TEST(RunUncertainty, ReportsImpossibleAnglesAndKeepsTheNoise) {
  const Rig rig = rig_x_with("D", "u_direction_mrad = 300");
  const auto found = run_uncertainty(rig, measured(rig, 10e-9));
  EXPECT_TRUE(found.noise_only);
  EXPECT_NE(covers_text(found).find("u_direction_mrad"), std::string::npos);
  EXPECT_GT(found.points[0].u[kEYX], 0);
}

TEST(RunUncertainty, PartOfARunWithItsFirstPointHasTheSameU) {
  const Rig rig =
      rig_x_with("B", "u_sensitivity_ppm = 500", "[drift]\nu_um_per_h = 1\n[encoder]\nu_um = 1\n");
  const auto run = measured(rig, 10e-9);
  const auto whole = stop_uncertainty(rig, run);
  auto page = run;
  page.points.erase(page.points.begin() + 1, page.points.begin() + 40);
  const auto some = stop_uncertainty(rig, page);
  for (std::size_t j = 1; j < some.points.size(); ++j)
    for (std::size_t k = 0; k < 5; ++k)
      EXPECT_DOUBLE_EQ(some.points[j].u[k], whole.points[j + 39].u[k]) << j << " " << k;
}

TEST(RunUncertainty, IsEmptyWithoutPoints) {
  const Rig rig = rig_x_with("B", "u_sensitivity_ppm = 500");
  EXPECT_TRUE(run_uncertainty(rig, without_points()).points.empty());
}

// A removed drift acts on EYX only. It includes the slow noise of EYX, so that the random variance
// of EYX is the noise of the stop; the other errors keep the scatter of the visits.
TEST(RunUncertainty, RemovedDriftReplacesTheScatterOfItsError) {
  const Rig rig = rig_x_with("", "");
  SyntheticRun synthetic{.rig = rig, .model = Model::simplified};
  synthetic.u_reading_m = 10e-9;
  synthetic.added = [&](std::size_t k, double, double, double time_s) {
    const int pass = static_cast<int>((time_s - 5) / 90);
    return k < 3 ? (pass % 3 - 1) * 100e-9 : (pass % 2 == 0 ? 1 : -1) * (pass / 2 - 1) * 100e-9;
  };
  const auto run = synthetic.measure();
  const auto before = PointUncertainties(run).stated();
  Contributor drift;
  drift.name = {ContributorKind::removed_drift};
  drift.declared.u = 1;
  std::vector<PointShifts> parts(2, PointShifts(run.points.size()));
  for (PointShifts& part : parts)
    for (Errors5& shift : part) shift[kDy] = 30e-9;
  PointUncertainties points(run);
  points.add(drift, parts);
  const auto after = points.stated();
  for (std::size_t j = 0; j < run.points.size(); ++j) {
    const double noise =
        std::sqrt(named_from_local(Axis::x, run.points[j].errors.covariance)[6 * kEYX]);
    EXPECT_GT(before[j].u_random[kEYX], 2 * noise);
    EXPECT_NEAR(after[j].u_random[kEYX], noise, 1e-15);
    EXPECT_NEAR(after[j].u[kEYX], std::hypot(noise, 30e-9, 30e-9), 1e-15);
    for (const auto k : {kEZX, kEAX, kEBX, kECX}) EXPECT_EQ(after[j].u[k], before[j].u[k]);
  }
  // A contributor without an effect, and another contributor, leave the scatter.
  PointUncertainties none(run), other(run);
  none.add(drift, {PointShifts(run.points.size())});
  drift.name = {ContributorKind::simplified_model};
  other.add(drift, parts);
  EXPECT_EQ(none.stated()[5].u_random, before[5].u_random);
  EXPECT_EQ(other.stated()[5].u_random, before[5].u_random);
}

}  // namespace
}  // namespace mdof::algo
