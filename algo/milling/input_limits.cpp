#include "algo/milling/input_limits.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace mdof::algo {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kMostHelix_rad = 80 * std::numbers::pi / 180;

struct InputLimits {
  double least = 0, most = kInfinite;
  bool includes_least = true;

  bool contain(double x) const { return (includes_least ? x >= least : x > least) && x <= most; }
};

InputLimits limits_of(const MillingPlan& plan, double MillingPlan::*input) {
  using P = MillingPlan;
  if (input == &P::runout_angle_rad) return {-kInfinite, kInfinite, true};
  if (input == &P::helix_rad) return {0, kMostHelix_rad, true};
  if (input == &P::runout_m)
    return {0, plan.radius_m() / 10 - std::abs(plan.runout_tilt) * plan.axial_depth_m, true};
  if (input == &P::feed_per_tooth_m) return {0, plan.radius_m() / plan.teeth, false};
  if (input == &P::radial_depth_m) return {0, plan.diameter_m, false};
  if (input == &P::axial_depth_m) return {0, plan.overhang_m(), false};
  if (input == &P::overhang_factor)
    return {plan.axial_depth_m * plan.overhang_factor / plan.overhang_m(), kInfinite, true};
  if (input == &P::beam_diameter_factor) return {0, kInfinite, false};
  if (input == &P::youngs_modulus_Pa || input == &P::Kt) return {0, kInfinite, false};
  return {};  // Kr, Kte, Kre
}

}  // namespace

bool is_cut(const MillingPlan& plan) {
  const auto& inputs = milling_inputs();
  return std::all_of(inputs.begin(), inputs.end(), [&](const MillingInput& input) {
    const double value = plan.*(input.member);
    const bool is_runout = input.member == &MillingPlan::runout_m;
    return limits_of(plan, input.member).contain(is_runout ? std::abs(value) : value);
  });
}

void set_input(MillingPlan& plan, const MillingInput& input, double value) {
  const InputLimits limits = limits_of(plan, input.member);
  if (input.member == &MillingPlan::radial_depth_m) value = std::min(value, limits.most);
  if (input.member != &MillingPlan::runout_m && limits.includes_least)
    value = std::max(value, limits.least);
  plan.*(input.member) = value;
}

InputStep input_step(const MillingPlan& plan, const MillingInput& input, double u) {
  const InputLimits limits = limits_of(plan, input.member);
  const double value = plan.*(input.member), high = std::min(value + u, limits.most);
  double low = value - u;
  if (!limits.includes_least && low <= limits.least) low = high > value ? value : value / 2;
  InputStep step{plan, plan, 0};
  step.higher.*(input.member) = high;
  step.lower.*(input.member) = std::max(low, limits.least);
  step.width = step.higher.*(input.member) - step.lower.*(input.member);
  return step;
}

}  // namespace mdof::algo
