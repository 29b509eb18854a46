// What a plan draws, names and cannot solve. Found missing by tests/mutate.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "algo/sensitivity/plan/experiment.h"
#include "tests/algo/sensitivity/plan_text.h"

namespace mdof::algo {
namespace {

std::unique_ptr<ScalableExperiment> experiment_with(const std::string& text) {
  const auto plan = parse_study_plan("name = \"t\"\nrig = \"../five-probe/rig_X.toml\"\n" + text,
                                     MDOF_TEST_DATA "/sensitivity/plan.toml");
  EXPECT_TRUE(plan) << (plan ? "" : plan.error().message);
  auto experiment = make_plan_experiment(plan.value());
  EXPECT_TRUE(experiment) << (experiment ? "" : experiment.error().message);
  return std::move(*experiment);
}

// The first output of trials 0 ... n - 1.
std::vector<double> first_output(const Experiment& e, std::size_t n) {
  std::vector<std::vector<double>> all(e.outputs().size(), std::vector<double>(n));
  std::vector<double*> place;
  for (auto& column : all) place.push_back(column.data());
  e.run(0, 1, n, place);
  return all[0];
}

double drawn(const ScalableExperiment& e, const std::string& name) {
  for (const auto& [known, value] : e.inputs(5))
    if (known == name) return value;
  ADD_FAILURE() << "nothing of the name " << name << " is drawn";
  return 0;
}

// 0.3 rad are beyond what the model holds for.
TEST(PlanRules, AnglesBeyondTheModelAreNotSolved) {
  for (const char* const forward : {"small-angle", "rigid"}) {
    for (const char* const angle : {"EAX_urad", "EBX_urad", "ECX_urad"}) {
      for (const auto& [value, solved] : {std::pair("240000", true), std::pair("260000", false)}) {
        const auto e =
            experiment_with("model = \"rigid\"\nforward = \"" + std::string(forward) +
                            "\"\n[truth]\ntravel_mm = [30]\n" + angle + " = [" + value + "]\n");
        EXPECT_EQ(std::isfinite(first_output(*e, 1)[0]), solved) << forward << " " << angle;
      }
    }
  }
}

// Of constant size, but each in a direction that is drawn.
TEST(PlanRules, ATiltAndACircleVaryByTheirDirection) {
  const auto e =
      experiment_with("[truth]\ntravel_mm = [30]\n" +
                      quantity("probe.A.tilt_mrad", "distribution = \"constant\"\nvalue = 1") +
                      quantity("probe.E.position_um", "distribution = \"constant\"\nvalue = 10") +
                      quantity("probe.B.x_um", "distribution = \"constant\"\nvalue = 10"));
  EXPECT_EQ(e->causes(), (std::vector<std::string>{"probe.A.tilt_mrad", "probe.E.position_um"}));
  EXPECT_EQ(drawn(*e, "probe.A.tilt_mrad"), 1);
  EXPECT_GT(drawn(*e, "probe.A.tilt_mrad direction/turns"), 0);
  EXPECT_GT(drawn(*e, "probe.E.position_um direction/turns"), 0);
}

// What is drawn together keeps the directions that each has alone.
TEST(PlanRules, ACorrelatedCircleHasItsOwnDirection) {
  const std::string circles =
      "[truth]\ntravel_mm = [30]\n" +
      quantity("probe.D.position_um", "distribution = \"normal\"\nsd = 10") +
      quantity("probe.E.position_um", "distribution = \"normal\"\nsd = 10");
  const auto apart = experiment_with(circles);
  const auto together = experiment_with(
      circles +
      "[[correlation]]\nquantities = [\"probe.D.position_um\", \"probe.E.position_um\"]\n"
      "matrix = [[1, 0.5], [0.5, 1]]\n");
  for (const char* const probe : {"D", "E"}) {
    const std::string name = "probe." + std::string(probe) + ".position_um direction/turns";
    EXPECT_EQ(drawn(*together, name), drawn(*apart, name)) << probe;
  }
  EXPECT_NEAR(drawn(*together, "probe.D.position_um"), drawn(*apart, "probe.D.position_um"), 1e-9);
  EXPECT_NE(drawn(*together, "probe.E.position_um"), drawn(*apart, "probe.E.position_um"));
}

// At a pitch of 1 mrad an encoder that scatters by 1 mm gives heights that scatter by 1 um, anew at
// each position: the straightness is wrong by parts of it.
TEST(PlanRules, TheEncodersNoiseIsDrawnAnewAtEachPosition) {
  const std::string head =
      "outputs = [\"EZX_straightness_um\"]\n"
      "[truth]\ntravel_mm = [0, 60]\nEBX_urad = [1000]\n[series]\npositions = 25\n";
  const auto mean = [](const std::vector<double>& x) {
    double sum = 0;
    for (const double v : x) sum += std::abs(v);
    return sum / static_cast<double>(x.size());
  };
  const auto noisy =
      experiment_with(head + quantity("encoder.noise_nm", "distribution = \"normal\"\nsd = 1e6"));
  const auto quiet = experiment_with(head);
  EXPECT_GT(mean(first_output(*noisy, 200)), 0.3);
  EXPECT_LT(mean(first_output(*quiet, 200)), 1e-3);
}

// Mountings and planes beyond 0.25 rad, too.
TEST(PlanRules, MountingsBeyondTheModelAreNotSolved) {
  for (const char* const name :
       {"installation.top.yaw_mrad", "installation.side.yaw_mrad", "target.top.pitch_mrad",
        "target.side.yaw_mrad", "probe.A.tilt_mrad"})
    for (const auto& [value, solved] : {std::pair("245", true), std::pair("255", false)}) {
      const auto e = experiment_with(
          "forward = \"rigid\"\n[truth]\ntravel_mm = [0.01]\n" +
          quantity(name, std::string("distribution = \"constant\"\nvalue = ") + value));
      EXPECT_EQ(std::isfinite(first_output(*e, 1)[0]), solved) << name << " " << value;
    }
}

}  // namespace
}  // namespace mdof::algo
