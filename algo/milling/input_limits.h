// Limits of the inputs of a cut. The random trials and the differences by which uncertainties are
// calculated use the same limits. They are those of parse_milling_plan(). SI units.
#pragma once

#include "schema/milling/milling_plan.h"

namespace mdof::algo {

// Returns whether the model can calculate this cut. A negative run-out is a run-out at the opposite
// angle.
bool is_cut(const MillingPlan& plan);

// Sets an input to a random value. A radial depth above the tool diameter becomes the diameter (a
// slot). A negative helix angle or force coefficient becomes 0. The caller must check the result
// with is_cut().
void set_input(MillingPlan& plan, const MillingInput& input, double value);

// Two plans that differ in one input, for the derivative by this input.
struct InputStep {
  MillingPlan lower, higher;
  double width = 0;  // higher - lower
};
// The values input ± u, limited to values of a cut. If the input must be positive and is not larger
// than its u, `lower` has the input itself, or half of it if `higher` already has the input itself.
InputStep input_step(const MillingPlan& plan, const MillingInput& input, double u);

}  // namespace mdof::algo
