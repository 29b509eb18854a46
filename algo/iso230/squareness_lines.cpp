#include "algo/iso230/squareness_lines.h"

#include "algo/iso230/reference_lines.h"
#include "algo/iso230/target_means.h"
#include "algo/model/restate.h"

namespace mdof::algo {
namespace {

// Of the horizontal straightness, EYX for X and EXY for Y: the first named error of both.
Result<ReferenceLines> horizontal_lines(const Run& measured) {
  const Run run = restate(measured, kAtFixture);
  const auto series = target_means(run.header.moving(), run.points, Approach::both);
  auto lines = reference_lines(own_travels(run.header.sides, series), column(series, 0));
  if (!lines) return in_context("run " + std::to_string(run.header.id), std::move(lines.error()));
  return lines;
}

SquarenessLine squareness_by(const ReferenceLine& x, const ReferenceLine& y,
                             const SquareArtefact& by) {
  return {x.slope_rad, y.slope_rad, -y.slope_rad - x.slope_rad + by.corner * by.angle_error_rad};
}

}  // namespace

Result<SquarenessLines> squareness_lines(const Run& run_x, const Run& run_y,
                                         const Squareness& fitted) {
  MDOF_TRY(const ReferenceLines x, horizontal_lines(run_x));
  MDOF_TRY(const ReferenceLines y, horizontal_lines(run_y));
  return SquarenessLines{squareness_by(x.end_point, y.end_point, fitted.artefact),
                         {fitted.slope_EYX_rad, fitted.slope_EXY_rad, fitted.EC0Y_rad},
                         squareness_by(x.minimum_zone, y.minimum_zone, fitted.artefact)};
}

}  // namespace mdof::algo
