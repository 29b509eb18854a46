// Sensitivity of force and wall to the inputs of a plan, by differences and by Monte Carlo.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "algo/milling/milling.h"
#include "algo/sensitivity/experiment.h"

namespace mdof::algo {

// An input that varies with a normal distribution.
struct VaryingInput {
  const MillingInput* input = nullptr;
  double u = 0;          // SI
  bool declared = true;  // false: u is 1 % of the input
};
// The inputs of milling_inputs() that have a declared u or are not 0.
std::vector<VaryingInput> varying_inputs(const DeclaredMillingPlan& declared);

// x_max_N, y_max_N, deflection_um, offset_um (mean of the wall), form_um, waviness_tip_um.
const std::vector<std::string>& milling_outputs();
std::vector<double> milling_output_values(const MillingResult& result);

// Effect of u of each input on each output, from the difference between + u and - u:
// [input][output]. Errors: those of milling().
Result<std::vector<std::vector<double>>> milling_effects(const MillingPlan& plan,
                                                         const std::vector<VaryingInput>& inputs);

// Each trial solves the plan with all inputs drawn, with at most this number of steps a turn; the
// effects of inputs hardly depend on the number. Draw q is for input q. A trial is unsolved if the
// drawn values describe no cut or have no equilibrium.
inline constexpr int kTrialStepsPerTurn = 720;
std::unique_ptr<CausalExperiment> milling_trials(const MillingPlan& plan,
                                                 const std::vector<VaryingInput>& inputs,
                                                 std::uint64_t seed);

}  // namespace mdof::algo
