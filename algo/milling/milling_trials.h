// Calculates the sensitivity of the forces and of the wall to the inputs of a plan, by differences
// and by the Monte Carlo method.
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
// Returns the inputs of milling_inputs() that have a declared u or a value other than 0.
std::vector<VaryingInput> varying_inputs(const DeclaredMillingPlan& declared);

// Returns the names of the outputs: x_max_N, y_max_N, deflection_um, offset_um (mean of the wall),
// form_um, waviness_tip_um.
const std::vector<std::string>& milling_outputs();
std::vector<double> milling_output_values(const MillingResult& result);

// Returns the effect of the u of each input on each output: [input][output]. It is calculated from
// the outputs for the input + u and for the input - u (input_step()). Errors: the errors of
// milling().
Result<std::vector<std::vector<double>>> milling_effects(const MillingPlan& plan,
                                                         const std::vector<VaryingInput>& inputs);

// Each trial simulates the plan with random values of all inputs; random number q is for input q. A
// trial has at most kTrialStepsPerTurn steps per turn, because the effects of the inputs hardly
// depend on this number. A trial has no result if the random values describe no cut (is_cut()) or
// if there is no equilibrium.
inline constexpr int kTrialStepsPerTurn = 720;
std::unique_ptr<CausalExperiment> milling_trials(const MillingPlan& plan,
                                                 const std::vector<VaryingInput>& inputs,
                                                 std::uint64_t seed);

}  // namespace mdof::algo
