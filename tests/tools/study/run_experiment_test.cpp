// Trials of a study that are whole simulated runs.
#include "tools/mdof/study/running/run_experiment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace mdof::tools {
namespace {

const std::string kFolder = std::string(MDOF_TEST_DATA) + "/sensitivity/";

std::string plan_text(const std::string& quantities, const std::string& truth) {
  return "name = \"t\"\nrig = \"../five-probe/rig_X.toml\"\noutput_of = \"run\"\n"
         "outputs = [\"EYX_worst_um\", \"EBX_worst_urad\", \"EYX_straightness_um\"]\n[truth]\n" +
         truth + quantities + "[run]\ntargets_mm = [0, 10, 20]\nrate_hz = 400\n";
}

std::string constant(const std::string& name, double value) {
  return "[[quantity]]\nname = \"" + name +
         "\"\ndistribution = \"constant\"\nvalue = " + std::to_string(value) + "\n";
}

std::vector<std::vector<double>> run(const std::string& text, std::size_t n,
                                     std::uint64_t first = 0) {
  const auto plan = parse_study_plan(text, kFolder + "plan.toml");
  EXPECT_TRUE(plan) << plan.error().message;
  const auto e = make_run_experiment(*plan);
  EXPECT_TRUE(e) << e.error().message;
  std::vector<std::vector<double>> values((*e)->outputs().size(), std::vector<double>(n));
  std::vector<double*> place;
  for (auto& v : values) place.push_back(v.data());
  (*e)->run(first, 1, n, place);
  return values;
}

TEST(StudyRun, ARunWithoutPerturbationMeasuresTheTrueErrors) {
  const auto x = run(plan_text("", "EYX_um = [2]\nEBX_urad = [50]\n"), 3);
  for (const auto& output : x)
    for (const double v : output) EXPECT_NEAR(v, 0, 1e-4);
}

// The side probes have an error of sensitivity of 1 %, and the wave of EYX has ±2 µm. A reading is
// then wrong by at most 20 nm, or less if no target is at the maximum of the wave.
TEST(StudyRun, ASensitivityErrorAppearsInTheRun) {
  const auto x = run(plan_text(constant("probe.D.sensitivity_percent", 1) +
                                   constant("probe.E.sensitivity_percent", 1),
                               "EYX_um = [2]\n"),
                     10);
  for (const double worst : x[0]) {
    EXPECT_GT(worst, 0.002);
    EXPECT_LT(worst, 0.0401);  // the zero at d = 0 contains no motion errors
  }
}

// The axis has no errors of motion. The means of about 100 samples with 50 nm of noise (A, B, C)
// give a pitch of some µrad.
TEST(StudyRun, NoiseIsAveragedByTheDwell) {
  const std::string noise =
      "[[quantity]]\nname = \"probe.*.noise_nm\"\ndistribution = \"normal\"\nsd = 50\n";
  const auto x = run(plan_text(noise, "EYX_um = [0]\n"), 20);
  double mean = 0;
  for (const double v : x[1]) mean += v / 20;
  // The pitch from one sample has sd = 50 √1.5/10 = 6.1 µrad. A mean has 60 to 160 samples. The
  // largest of six means is about 1 µrad.
  EXPECT_GT(mean, 0.4);
  EXPECT_LT(mean, 1.6);
}

TEST(StudyRun, ATrialAloneGivesTheSameResult) {
  const std::string text = plan_text(
      "[[quantity]]\nname = \"encoder.noise_nm\"\ndistribution = \"normal\"\nsd = 20\n"
      "[[quantity]]\nname = \"probe.*.drift_nm\"\ndistribution = \"normal\"\nsd = 20\n",
      "EYX_um = [-2, 2]\n");
  const auto all = run(text, 4, 10);
  const auto alone = run(text, 1, 12);
  for (std::size_t k = 0; k < all.size(); ++k) EXPECT_EQ(alone[k][0], all[k][2]);
  EXPECT_NE(all[0][0], all[0][1]);
}

TEST(StudyRun, ATargetOutOfRangeIsNotSolved) {
  const auto x = run(plan_text(constant("probe.A.zero_nm", 500'000), "EYX_um = [2]\n"), 1);
  EXPECT_TRUE(std::isnan(x[0][0]));
  EXPECT_TRUE(std::isnan(x[2][0]));
}

TEST(StudyRun, RefusesAnUndeterminedRigAndCorrelatedNoise) {
  auto plan = parse_study_plan("name = \"t\"\nrig = \"rig_blind.toml\"\noutput_of = \"run\"\n",
                               kFolder + "plan.toml");
  ASSERT_TRUE(plan);
  const auto blind = make_run_experiment(*plan);
  ASSERT_FALSE(blind);
  EXPECT_NE(blind.error().message.find("cannot"), std::string::npos) << blind.error().message;
  plan = parse_study_plan(
      plan_text("[[quantity]]\nname = \"probe.*.noise_nm\"\ndistribution = \"normal\"\nsd = 5\n"
                "[[correlation]]\nquantities = [\"probe.*.noise_nm\"]\ncoefficient = 0.5\n",
                "EYX_um = [2]\n"),
      kFolder + "plan.toml");
  ASSERT_TRUE(plan) << plan.error().message;
  const auto noise = make_run_experiment(*plan);
  ASSERT_FALSE(noise);
  EXPECT_NE(noise.error().message.find("each sample is independent"), std::string::npos);
}

}  // namespace
}  // namespace mdof::tools
