#include "algo/iso230/squareness.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "algo/iso230/line_fit.h"
#include "algo/iso230/square_tilt.h"
#include "algo/iso230/target_means.h"
#include "algo/model/fixture.h"
#include "algo/model/restate.h"
#include "algo/sequence/uneven_visits.h"
#include "algo/sequence/usable_runs.h"
#include "schema/base/number/number_text.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

constexpr double kAcross = 0.7;  // smallest cosine between a plane's normal and the axis

int sign_of(double x) {
  return x > 0 ? 1 : x < 0 ? -1 : 0;
}

// Returns the sign of the outward normal of the faces that are perpendicular to the axis `along`;
// 0: the sign is unknown, or there is no such face. The material of the square is around the origin
// of M, so the sign follows from the position of the face. The top target plane contains this
// origin; its sign follows from its normal, the local z.
Result<int> side_of_face(const Rig& rig, Axis along) {
  MDOF_TRY(const Fixture fixture, make_fixture(rig));
  // The axis `along` in local coordinates.
  const auto row = local_axes(rig.axis)[static_cast<std::size_t>(along)];
  int side = 0;
  for (const FixtureProbe& probe : fixture.probes) {
    const double normal = row[0] * probe.n_C.x() + row[1] * probe.n_C.y() + row[2] * probe.n_C.z();
    if (std::abs(normal) < kAcross) continue;
    int of_this = sign_of(probe.plane_offset_m / normal);
    if (row[2] != 0) {
      const int faces = sign_of(normal);
      if (of_this == -faces) return 0;
      of_this = faces;
    }
    if (of_this == 0 || (side != 0 && side != of_this)) return 0;
    side = of_this;
  }
  return side;
}

std::string in_urad(double rad) {
  return plain_number(to_urad(rad), 6) + " urad";
}

tl::unexpected<Error> contradiction(const Rig& x, const Rig& y, const char* key, double of_x,
                                    double of_y, Remedy remedy) {
  return bad_input(std::string(key) + " is " + in_urad(of_x) + " in " + x.source + " and " +
                       in_urad(of_y) + " in " + y.source +
                       ", but both runs measure the same square",
                   remedy);
}

// Slope of the straightness of one axis in the direction of the other axis.
struct StraightnessSlope {
  Line line;
  double u_slope_rad = 0;
};

double propagated(const std::vector<double>& x, const std::vector<TargetMean>& series,
                  std::size_t named) {
  double mean = 0, sxx = 0, sum = 0, trend = 0;
  for (const double v : x) mean += v / static_cast<double>(x.size());
  for (const double v : x) sxx += (v - mean) * (v - mean);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double by = (x[i] - mean) / sxx, u = series[i].u[named];
    const double of_trend = series[i].u_trend[named];
    sum += by * by * (u * u - of_trend * of_trend);
    trend += by * of_trend;
  }
  return std::sqrt(std::max(0.0, sum) + trend * trend);
}

// [run][target]: differences of the visits of a target from the mean of all visits from the same
// side, m.
using DeviationsFromMean = std::map<int, std::map<int, std::vector<double>>>;

DeviationsFromMean deviations_from_mean(const MovingAxis& moving,
                                        const std::vector<MeasuredPoint>& points,
                                        std::size_t named) {
  const auto value = [&](const MeasuredPoint& p) {
    return named_from_local(moving, p.errors.local)[named];
  };
  struct Mean {
    double sum = 0, n = 0;
  };
  std::map<std::pair<int, int>, Mean> means;  // key: target and direction
  for (const MeasuredPoint& p : points) {
    Mean& mean = means[{p.target, p.point.direction}];
    mean.sum += value(p);
    mean.n += 1;
  }
  DeviationsFromMean off;
  for (const MeasuredPoint& p : points) {
    const Mean& mean = means[{p.target, p.point.direction}];
    if (mean.n > 1) off[p.run][p.target].push_back(value(p) - mean.sum / mean.n);
  }
  return off;
}

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

// Returns s/√n of the slopes of runs; 0 for fewer than two runs. Only runs with at least three
// targets and at least half of all targets count. The slopes are fitted to the differences from the
// mean of the runs. Therefore the form and the backlash of the axis do not increase the scatter if
// a target is missing in a run.
double scatter_of_runs(const MovingAxis& moving, const std::vector<MeasuredPoint>& points,
                       std::size_t named) {
  std::map<int, double> travel_m;  // key: target
  for (const MeasuredPoint& p : points)
    travel_m.emplace(p.target, moving.sides.moving_body_travel_m(p.point.position_m));
  std::vector<double> slopes;
  for (const auto& [run, targets] : deviations_from_mean(moving, points, named)) {
    std::vector<double> x, y;
    for (const auto& [target, off] : targets) {
      x.push_back(travel_m[target]);
      y.push_back(mean_of(off));
    }
    if (x.size() >= 3 && 2 * x.size() >= travel_m.size() && can_fit(x))
      slopes.push_back(least_squares_line(x, y).slope);
  }
  if (slopes.size() < 2) return 0;
  const auto n = static_cast<double>(slopes.size());
  const double mean = mean_of(slopes);
  double square = 0;
  for (const double s : slopes) square += (s - mean) * (s - mean);
  return std::sqrt(square / (n - 1) / n);
}

Result<StraightnessSlope> straightness_slope(const Run& measured, std::size_t named,
                                             const StatedAt& at) {
  const Run run = restate(measured, at);
  const auto series = target_means(run.header.moving(), run.points, Approach::both);
  const auto x = own_travels(run.header.sides, series);
  if (series.size() < 3 || !can_fit(x)) {
    return bad_input("run " + std::to_string(run.header.id) + " has " +
                     std::to_string(series.size()) +
                     " targets with calculated errors, but a straight line with uncertainty needs "
                     "at least three");
  }
  StraightnessSlope slope;
  slope.line = least_squares_line(x, column(series, named));
  slope.u_slope_rad =
      std::max(propagated(x, series, named),
               scatter_of_runs(run.header.moving(), subtract_run_drifts(run.points).points, named));
  return slope;
}

constexpr double kMostArtefact_rad = 0.01;  // an artefact with a larger error is no square

Status check_given(const ArtefactGiven& given) {
  const double angle_rad = given.angle_error_rad.value_or(0), u_rad = given.u_rad.value_or(0);
  if (!(std::abs(angle_rad) <= kMostArtefact_rad))
    return bad_input("the angle error of the square must be from -10000 to 10000 urad");
  if (!(u_rad >= 0 && u_rad <= kMostArtefact_rad))
    return bad_input("the standard uncertainty of the square's angle must be from 0 to 10000 urad");
  return {};
}

}  // namespace

Result<AxisPair> pair_of(const Run& a, const Run& b) {
  if (a.header.axis < b.header.axis) return AxisPair{a.header.axis, b.header.axis};
  const auto of = [](const Run& run) {
    return "run " + std::to_string(run.header.id) + " measures axis " + letter(run.header.axis);
  };
  return bad_input(of(a) + " and " + of(b) +
                   "; give runs of two different axes, in the order X, Y, Z");
}

Result<SquareArtefact> combined_artefact(const Rig& rig_a, const Rig& rig_b,
                                         const ArtefactGiven& given) {
  constexpr const char* kAngle = "artefact_angle_error_urad";
  MDOF_CHECK(check_given(given));
  SquareArtefact artefact;
  const auto a = rig_a.artefact_angle_error_rad, b = rig_b.artefact_angle_error_rad;
  if (!given.angle_error_rad && a && b && *a != *b)
    return contradiction(rig_a, rig_b, kAngle, *a, *b, Remedy::choose_artefact_angle);
  artefact.angle_error_rad = given.angle_error_rad.value_or(a.value_or(b.value_or(0)));
  const auto u_a = rig_a.u_artefact_angle_rad, u_b = rig_b.u_artefact_angle_rad;
  if (!given.u_rad && u_a && u_b && *u_a != *u_b)
    return contradiction(rig_a, rig_b, "u_artefact_angle_urad", *u_a, *u_b,
                         Remedy::choose_artefact_u);
  artefact.u_rad = given.u_rad ? given.u_rad : u_a ? u_a : u_b;
  MDOF_TRY(const int face_a, side_of_face(rig_a, rig_b.axis));
  MDOF_TRY(const int face_b, side_of_face(rig_b, rig_a.axis));
  artefact.corner = face_a * face_b;
  if (artefact.angle_error_rad == 0 || artefact.corner != 0) return artefact;
  const Rig &unclear = face_a == 0 ? rig_a : rig_b, &other = face_a == 0 ? rig_b : rig_a;
  return bad_input(unclear.source +
                   ": the rig does not state on which side of the square the face normal to " +
                   letter(other.axis) + " is, so the sign of " + kAngle +
                   " is unknown; give position_mm of the probes at this face, or offset_mm of the "
                   "[[plane]] of this face");
}

Result<Squareness> squareness(const Run& run_a, const Run& run_b, const SquareArtefact& artefact,
                              bool take_partial, const StatedPair& at) {
  Squareness s;
  MDOF_TRY(s.axes, pair_of(run_a, run_b));
  MDOF_CHECK(check_usable({&run_a, &run_b}, take_partial, "squareness"));
  MDOF_TRY(const StraightnessSlope a,
           straightness_slope(run_a, straightness_along(s.axes.a, s.axes.b), at.a));
  MDOF_TRY(const StraightnessSlope b,
           straightness_slope(run_b, straightness_along(s.axes.b, s.axes.a), at.b));
  s.run_a = run_a.header.id;
  s.run_b = run_b.header.id;
  s.slope_a_rad = a.line.slope;
  s.u_slope_a_rad = a.u_slope_rad;
  s.slope_b_rad = b.line.slope;
  s.u_slope_b_rad = b.u_slope_rad;
  s.artefact = artefact;
  s.error_rad = squareness_of(s.axes, s.slope_a_rad, s.slope_b_rad, artefact) +
                square_tilt_rad(run_a, run_b, s.axes);
  const double u_rad = artefact.u_rad.value_or(0);
  s.u_error_rad = std::sqrt(s.u_slope_a_rad * s.u_slope_a_rad + s.u_slope_b_rad * s.u_slope_b_rad +
                            u_rad * u_rad);
  s.form_rad = std::sqrt(a.line.u_slope * a.line.u_slope + b.line.u_slope * b.line.u_slope);
  s.simulated = run_a.header.simulated || run_b.header.simulated;
  return s;
}

}  // namespace mdof::algo
