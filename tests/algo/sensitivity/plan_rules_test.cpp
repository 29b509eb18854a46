// Draws, names and unsolved trials of a plan. Mutation tests (tests/mutate) found these cases.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "algo/sensitivity/plan/experiment.h"
#include "tests/algo/rigs.h"
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

// First output of the trials 0 ... n - 1.
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

// The model is valid for angles up to 0.25 rad.
TEST(PlanRules, DoesNotSolveAnglesBeyondTheModel) {
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

// The size of the deviation is constant; its direction is drawn in each trial.
TEST(PlanRules, TiltAndCircleVaryByTheirDirection) {
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

// The directions of quantities must be the same with and without a correlation.
TEST(PlanRules, CorrelatedCirclesKeepTheirDirections) {
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

// At a pitch of 1 mrad, an encoder noise of 1 mm changes the heights by 1 um. The noise is drawn
// anew at each position, so it changes the straightness.
TEST(PlanRules, EncoderNoiseIsDrawnAtEachPosition) {
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

// The angles of mountings and planes are also limited to 0.25 rad.
TEST(PlanRules, DoesNotSolveMountingsBeyondTheModel) {
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

// A normal travel is evaluated over ±2 standard deviations. A series over this travel must equal a
// series over the range of ±2 standard deviations.
TEST(PlanRules, NormalTravelCoversTwoStandardDeviations) {
  const auto series = [](const std::string& travel, const std::string& quantities) {
    return experiment_with(
        "outputs = [\"EYX_straightness_um\"]\n[truth]\n" + travel +
        "EYX_um = [10]\n[series]\npositions = 25\n" + quantities +
        quantity("probe.D.sensitivity_percent", "distribution = \"constant\"\nvalue = 1"));
  };
  const auto range = series("travel_mm = [10, 50]\n", "");
  const auto normal_travel =
      series("", quantity("travel_mm", "distribution = \"normal\"\nmean = 30\nsd = 10"));
  const auto range_travel_output = first_output(*range, 20),
             of_normal = first_output(*normal_travel, 20);
  for (std::size_t j = 0; j < 20; ++j) {
    EXPECT_GT(range_travel_output[j], 0.01);
    EXPECT_NEAR(of_normal[j], range_travel_output[j], 1e-12) << j;
  }
}

// A and B have noise at each reading. Each noise has its own scale factor, at a point and in a
// series.
TEST(PlanRules, EachNoiseHasItsOwnScale) {
  const auto noise = [](const char* probe) {
    return quantity(std::string("probe.") + probe + ".noise_nm",
                    "distribution = \"normal\"\nsd = 20");
  };
  for (const std::string& output : {std::string("EBX_urad"), std::string("EZX_straightness_um")}) {
    const bool is_series = output != "EBX_urad";
    const std::string head = "model = \"simplified\"\nforward = \"small-angle\"\noutputs = [\"" +
                             output + "\"]\n[truth]\ntravel_mm = [20, 40]\n" +
                             (is_series ? "[series]\npositions = 8\n" : "");
    const auto both = experiment_with(head + noise("A") + noise("B"));
    const auto scaled = [&](double of_A, double of_B) {
      std::vector<double> scale;
      for (const std::string& name : both->quantities())
        scale.push_back(name.starts_with("probe.A")   ? of_A
                        : name.starts_with("probe.B") ? of_B
                                                      : 1);
      std::vector<double> out(30);
      double* const place[] = {out.data()};
      both->run_scaled(scale, 0, 1, out.size(), place);
      return out;
    };
    const auto one = first_output(*both, 30), twice = scaled(2, 2), only_B = scaled(0, 3);
    const auto alone = first_output(*experiment_with(head + noise("B")), 30);
    for (std::size_t j = 0; j < 30; ++j) {
      EXPECT_NEAR(twice[j], 2 * one[j], 1e-9 + 1e-4 * std::abs(one[j])) << output << j;
      EXPECT_NEAR(only_B[j], 3 * alone[j], 1e-9 + 1e-4 * std::abs(alone[j])) << output << j;
    }
  }
}

// In two of these rigs the target moves against the encoder. Their travel has the opposite sign of
// the travel in the plan.
TEST(PlanRules, ErrorStatesHowToReplaceAMovingFixture) {
  const std::string folder = ::testing::TempDir() + "mdof_plan_rules_test";
  std::filesystem::create_directories(folder);
  const auto says = [&](const std::string& keys) {
    std::ofstream(folder + "/rig.toml") << keys << test::rig_x_toml();
    const auto plan = parse_study_plan(
        "name = \"t\"\nrig = \"rig.toml\"\n[truth]\ntravel_mm = [0, 60]\nEAX_urad = [1]\n",
        folder + "/plan.toml");
    EXPECT_TRUE(plan) << (plan ? "" : plan.error().message);
    const auto experiment = make_plan_experiment(plan.value());
    return experiment ? "" : experiment.error().message;
  };
  const auto negates = [](const std::string& why) {
    EXPECT_NE(why.find("moves = \"target\""), std::string::npos) << why;
    return why.find("reverse the sign of travel_mm") != std::string::npos;
  };
  EXPECT_TRUE(negates(says("travel = \"-\"\n")));
  EXPECT_TRUE(negates(says("moves = \"fixture\"\n")));
  EXPECT_FALSE(negates(says("moves = \"fixture\"\ntravel = \"-\"\n")));
  EXPECT_EQ(says(""), "");
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace mdof::algo
