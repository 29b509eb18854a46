#include "algo/uncertainty/stated.h"

#include <utility>

namespace mdof::algo {

StatedUncertainty stated_uncertainty(const Rig& rig, const Run& run) {
  RunUncertainty points;
  points.not_declared = rig.undeclared_uncertainties();
  PointUncertainties of_points(run);
  RunBudgets figures(rig, run);
  const auto declared = contributors(rig, run);
  points.declares = rig.declares_uncertainty();
  if (!declared && !run.points.empty()) points.why = declared.error().message;
  if (declared)
    for (const Contributor& contributor : *declared) {
      const std::vector<PointShifts> parts = contributor.parts();
      of_points.add(contributor, parts);
      figures.add(contributor, parts);
    }
  points.points = of_points.stated();
  points.visits = of_points.visits();
  set_zeros_to_unknown(points);
  points.noise_only = is_noise_only(points);
  if (!declared) return {std::move(points), tl::unexpected(declared.error())};
  return {std::move(points), std::move(figures)};
}

}  // namespace mdof::algo
