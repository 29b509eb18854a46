// The sensitivity of force and wall to the inputs of a plan, by differences and by Monte Carlo.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "algo/milling/milling.h"
#include "algo/sensitivity/experiment.h"

namespace mdof::algo {

// An input that varies, normally.
struct VaryingInput {
  const MillingInput* input = nullptr;
  double u = 0;          // SI
  bool declared = true;  // else 1 % of the input, as nothing is declared of it
};
// Those of milling_inputs() that are declared or not 0.
std::vector<VaryingInput> varying_inputs(const DeclaredMillingPlan& declared);

// x_max_N, y_max_N, deflection_um, offset_um (mean of the wall), form_um, waviness_tip_um.
const std::vector<std::string>& milling_outputs();
std::vector<double> milling_output_values(const MillingResult& result);

// What u of each input does to each output, by the difference between + u and - u: [input][output].
// Error: as milling().
Result<std::vector<std::vector<double>>> milling_effects(const MillingPlan& plan,
                                                         const std::vector<VaryingInput>& inputs);

// Each trial solves the plan with all inputs drawn, in at most so many steps a turn: what comes of
// an input hardly depends on them. Draw q is input q. Unsolved: a cut that is none or has no
// equilibrium.
inline constexpr int kTrialStepsPerTurn = 720;
std::unique_ptr<CausalExperiment> milling_trials(const MillingPlan& plan,
                                                 const std::vector<VaryingInput>& inputs,
                                                 std::uint64_t seed);

}  // namespace mdof::algo
