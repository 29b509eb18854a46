#include "algo/milling/milling_trials.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "algo/milling/input_limits.h"
#include "algo/sensitivity/random.h"
#include "schema/base/random.h"

namespace mdof::algo {
namespace {

constexpr double kAssumedShare = 0.01;

class MillingTrials : public CausalExperiment {
 public:
  MillingTrials(const MillingPlan& plan, const std::vector<VaryingInput>& inputs,
                std::uint64_t seed)
      : plan_(plan), inputs_(inputs), seed_(seed) {
    plan_.steps_per_turn = std::min(plan.steps_per_turn, kTrialStepsPerTurn);
    outputs_ = milling_outputs();
    for (const VaryingInput& input : inputs) causes_.push_back(input.input->name());
  }

  void run(std::uint64_t first, std::uint64_t step, std::size_t n,
           std::span<double* const> out) const override {
    run_mixed({}, first, step, n, out);
  }
  void run_mixed(std::span<const std::uint8_t> second, std::uint64_t first, std::uint64_t step,
                 std::size_t n, std::span<double* const> out) const override {
    for (std::size_t j = 0; j < n; ++j) {
      const std::vector<double> values = trial(second, first + step * j);
      for (std::size_t k = 0; k < out.size(); ++k) out[k][j] = values[k];
    }
  }

 private:
  std::vector<double> trial(std::span<const std::uint8_t> second, std::uint64_t i) const {
    std::vector<double> unsolved(outputs().size(), std::numeric_limits<double>::quiet_NaN());
    MillingPlan drawn = plan_;
    for (std::size_t q = 0; q < inputs_.size(); ++q) {
      const std::uint32_t stream = q < second.size() && second[q] != 0 ? 1 : 0;
      const MillingInput& input = *inputs_[q].input;
      set_input(drawn, input,
                plan_.*(input.member) + inputs_[q].u * gaussian(draw({seed_, stream}, i, q)));
    }
    if (!is_cut(drawn)) return unsolved;
    const auto result = milling(drawn);
    return result ? milling_output_values(*result) : unsolved;
  }

  MillingPlan plan_;
  std::vector<VaryingInput> inputs_;
  std::uint64_t seed_;
};

}  // namespace

std::vector<VaryingInput> varying_inputs(const DeclaredMillingPlan& declared) {
  std::vector<VaryingInput> inputs;
  for (const MillingInput& input : milling_inputs()) {
    VaryingInput varying{&input, std::abs(declared.plan.*(input.member)) * kAssumedShare, false};
    for (const auto& [of, u] : declared.u)
      if (of == &input) varying = {&input, u, true};
    if (varying.u > 0) inputs.push_back(varying);
  }
  return inputs;
}

const std::vector<std::string>& milling_outputs() {
  static const std::vector<std::string> outputs = {"x_max_N",   "y_max_N", "deflection_um",
                                                   "offset_um", "form_um", "waviness_tip_um"};
  return outputs;
}

std::vector<double> milling_output_values(const MillingResult& r) {
  return {r.x_max_N,
          r.y_max_N,
          r.deflection_m * 1e6,
          r.wall.offset_mean_m * 1e6,
          r.wall.form_m * 1e6,
          r.wall.waviness_tip_m * 1e6};
}

Result<std::vector<std::vector<double>>> milling_effects(const MillingPlan& plan,
                                                         const std::vector<VaryingInput>& inputs) {
  std::vector<std::vector<double>> effects;
  for (const VaryingInput& input : inputs) {
    const InputStep step = input_step(plan, *input.input, input.u);
    MDOF_TRY(const MillingResult above, milling(step.higher));
    MDOF_TRY(const MillingResult below, milling(step.lower));
    std::vector<double> row = milling_output_values(above);
    const std::vector<double> from = milling_output_values(below);
    for (std::size_t k = 0; k < row.size(); ++k) row[k] = (row[k] - from[k]) / step.width * input.u;
    effects.push_back(row);
  }
  return effects;
}

std::unique_ptr<CausalExperiment> milling_trials(const MillingPlan& plan,
                                                 const std::vector<VaryingInput>& inputs,
                                                 std::uint64_t seed) {
  return std::make_unique<MillingTrials>(plan, inputs, seed);
}

}  // namespace mdof::algo
