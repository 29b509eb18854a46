// Figures of a run for budgets, as functions of the mean errors at the targets.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "algo/iso230/target_means.h"

namespace mdof::algo {

// The mean of both approaches at each target, in the order of the targets. `sides`: header.sides
// of the run.
struct MeanErrors {
  Sides sides;
  std::vector<TargetMean> targets;
};

struct Figure {
  std::string name;  // with the unit: "EYX_straightness_um"
  // Value in SI; NaN if the targets do not determine it.
  std::function<double(const MeanErrors&)> of;
  // Only for a range: the deviations whose highest minus lowest value is the figure. They are
  // linear in the means. Null for other figures. Noise makes a range larger; a calculation of first
  // order does not show this.
  std::function<std::vector<double>(const MeanErrors&)> deviations = nullptr;

  bool is_range() const { return static_cast<bool>(deviations); }
};

// `named`: index in error_names(axis).
Figure straightness_figure(Axis axis, std::size_t named);  // range about the least-squares line
Figure slope_figure(Axis axis, std::size_t named);  // slope over the travel of the moving body
Figure range_figure(Axis axis, std::size_t named);  // highest - lowest
Figure error_figure(Axis axis, std::size_t named, int target);

// Straightness and slope of the two straightness errors, then the range of each angle.
std::vector<Figure> figures_of_run(Axis axis);
// The five errors at a target.
std::vector<Figure> errors_at_target(Axis axis, int target);

}  // namespace mdof::algo
