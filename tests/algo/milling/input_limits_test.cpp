// Tests that trials and differences use the same limits, also at the ends of the inputs.
#include "algo/milling/input_limits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "algo/milling/milling_trials.h"

namespace mdof::algo {
namespace {

MillingPlan coarse_preset() {
  MillingPlan plan = parse_milling_plan(micro_end_mill_preset(), "preset")->plan;
  plan.elements = 2;
  plan.steps_per_turn = 360;
  return plan;
}

const MillingInput& input_of(const std::string& key) {
  for (const MillingInput& input : milling_inputs())
    if (key == input.key) return input;
  ADD_FAILURE() << key;
  return milling_inputs().front();
}

MillingPlan slot() {
  MillingPlan plan = coarse_preset();
  plan.radial_depth_m = plan.diameter_m;
  return plan;
}

// u may be much larger than the input.
TEST(InputStep, EndsAreCutsForAnyU) {
  for (const MillingPlan& plan : {coarse_preset(), slot()})
    for (const MillingInput& input : milling_inputs()) {
      const double value = plan.*(input.member);
      for (const double share : {1e-3, 1.0, 1.5, 1e3}) {
        const double u = share * (value > 0 ? value : 1e-3 * input.unit);
        const InputStep step = input_step(plan, input, u);
        EXPECT_TRUE(is_cut(step.lower)) << input.key << " " << share;
        EXPECT_TRUE(is_cut(step.higher)) << input.key << " " << share;
        EXPECT_GT(step.width, 0) << input.key << " " << share;
        EXPECT_EQ(step.width, step.higher.*(input.member) - step.lower.*(input.member));
      }
    }
}

TEST(InputStep, IsSymmetricWithinTheLimits) {
  const MillingPlan plan = coarse_preset();
  const InputStep step = input_step(plan, input_of("feed_per_tooth_um"), 2e-6);
  EXPECT_NEAR(step.lower.feed_per_tooth_m, 13e-6, 1e-15);
  EXPECT_NEAR(step.higher.feed_per_tooth_m, 17e-6, 1e-15);
  // A slot cannot become wider. Its derivative is that of a narrower cut.
  const InputStep wide = input_step(slot(), input_of("radial_depth_mm"), 5e-6);
  EXPECT_EQ(wide.higher.radial_depth_m, slot().diameter_m);
  EXPECT_NEAR(wide.width, 5e-6, 1e-15);
}

// A feed of 0 has no wall, so its calculation ended mdof.
TEST(WearOffset, HasAUForAFeedSmallerThanItsU) {
  DeclaredMillingPlan declared{coarse_preset(), {{&input_of("feed_per_tooth_um"), 16e-6}}};
  const auto offset = wear_offset(declared);
  ASSERT_TRUE(offset) << offset.error().message;
  EXPECT_TRUE(std::isfinite(offset->u_m));
  EXPECT_GT(offset->u_m, 0);
}

TEST(WearOffset, NamesTheInputsWithoutU) {
  DeclaredMillingPlan declared{coarse_preset(), {{&input_of("feed_per_tooth_um"), 1e-6}}};
  std::vector<std::string> names;
  const auto offset = wear_offset(declared);
  ASSERT_TRUE(offset) << offset.error().message;
  for (const MillingInput* input : offset->not_declared) names.emplace_back(input->key);
  // Kte and Kre are 0.
  EXPECT_EQ(names, (std::vector<std::string>{"helix_deg", "youngs_modulus_GPa", "radial_um",
                                             "angle_deg", "radial_depth_mm", "axial_depth_mm",
                                             "Kt_N_per_mm2", "Kr_N_per_mm2", "overhang_percent",
                                             "beam_diameter_percent"}));
}

TEST(SetInput, WidthBeyondTheDiameterIsASlot) {
  MillingPlan plan = coarse_preset();
  set_input(plan, input_of("radial_depth_mm"), 1.02 * plan.diameter_m);
  EXPECT_EQ(plan.radial_depth_m, plan.diameter_m);
  set_input(plan, input_of("radial_depth_mm"), 0.98 * plan.diameter_m);
  EXPECT_EQ(plan.radial_depth_m, 0.98 * plan.diameter_m);
  set_input(plan, input_of("Kte_N_per_mm"), -1);
  EXPECT_EQ(plan.Kte, 0);
  set_input(plan, input_of("feed_per_tooth_um"), -1e-6);
  EXPECT_FALSE(is_cut(plan));
}

// Half of the drawn widths are larger than the diameter.
TEST(MillingTrials, AllTrialsOfASlotHaveAResult) {
  const std::vector<VaryingInput> inputs = {
      {&input_of("radial_depth_mm"), 0.01 * slot().radial_depth_m, false}};
  const auto trials = milling_trials(slot(), inputs, 1);
  constexpr std::size_t n = 16;
  std::vector<double> out(milling_outputs().size() * n);
  std::vector<double*> at;
  for (std::size_t k = 0; k < milling_outputs().size(); ++k) at.push_back(&out[k * n]);
  trials->run(0, 1, n, at);
  for (std::size_t j = 0; j < n; ++j) EXPECT_TRUE(std::isfinite(out[j])) << j;
  EXPECT_TRUE(milling_effects(slot(), inputs));
}

// The deflection of a beam is proportional to length³ and diameter⁻⁴. The force of the rigid tool
// does not depend on them.
TEST(MillingEffects, ContainTheDimensionsOfTheBeam) {
  MillingPlan plan = coarse_preset();
  plan.deflection = DeflectionModel::rigid;
  plan.axial_depth_m = 1e-6;  // the force acts at the tip
  const double deflection_um = milling(plan)->deflection_m * 1e6;
  const auto effects = milling_effects(
      plan, {{&input_of("overhang_percent"), 0.001}, {&input_of("beam_diameter_percent"), 0.001}});
  ASSERT_TRUE(effects) << effects.error().message;
  ASSERT_EQ(milling_outputs()[2], "deflection_um");
  EXPECT_NEAR((*effects)[0][2] / deflection_um, 0.003, 1e-5);
  EXPECT_NEAR((*effects)[1][2] / deflection_um, -0.004, 1e-5);
  EXPECT_NEAR((*effects)[0][0], 0, 1e-12);
}

TEST(MillingPlan, DeclaresTheUOfTheBeamInPercent) {
  std::string text(micro_end_mill_preset());
  text.insert(text.find("overhang_mm"), "u_overhang_percent = 2\n");
  const auto declared = parse_milling_plan(text, "plan");
  ASSERT_TRUE(declared) << declared.error().message;
  ASSERT_EQ(declared->u.size(), 1u);
  EXPECT_STREQ(declared->u[0].first->key, "overhang_percent");
  EXPECT_NEAR(declared->u[0].second, 0.02, 1e-15);
  EXPECT_FALSE(parse_milling_plan("overhang_percent = 2\n" + text, "plan"));
}

}  // namespace
}  // namespace mdof::algo
