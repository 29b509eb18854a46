// Figures of a run as functions of its mean errors at the targets, for budgets.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "algo/iso230/target_means.h"

namespace mdof::algo {

// The mean of both approaches at each target, ascending. `sides`: those of the run.
struct MeanErrors {
  Sides sides;
  std::vector<TargetMean> targets;
};

struct Figure {
  std::string name;                             // with its unit: "EYX_straightness_um"
  std::function<double(const MeanErrors&)> of;  // SI; NaN if these targets do not determine it
  // The values whose highest minus lowest is the figure, linear in the means; null: the figure is
  // no range. Noise makes a range larger, and first order does not show that.
  std::function<std::vector<double>(const MeanErrors&)> deviations = nullptr;

  bool is_range() const { return static_cast<bool>(deviations); }
};

// `named`: index in error_names(axis).
Figure straightness_figure(Axis axis, std::size_t named);  // peak to valley, least-squares line
Figure slope_figure(Axis axis, std::size_t named);  // slope over the moving body's own travel
Figure range_figure(Axis axis, std::size_t named);  // highest - lowest
Figure error_figure(Axis axis, std::size_t named, int target);

// Straightness and slope of the two straightness errors, then the range of each angle.
std::vector<Figure> figures_of_run(Axis axis);
// The five errors at a target.
std::vector<Figure> errors_at_target(Axis axis, int target);

}  // namespace mdof::algo
