#include "algo/iso230/squareness.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "algo/iso230/line_fit.h"
#include "algo/iso230/target_means.h"
#include "algo/model/fixture.h"
#include "algo/model/restate.h"
#include "algo/sequence/uneven_visits.h"
#include "algo/sequence/usable_runs.h"
#include "schema/base/number/number_text.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

constexpr double kAcross = 0.7;  // cosine from which a plane faces across the motion, sideways

// On which side of M's origin the side faces lie, along + of the machine's other horizontal axis:
// +1 or -1; 0: at it, on both sides, or there is none.
Result<int> side_of_face(const Rig& rig) {
  MDOF_TRY(const Fixture fixture, make_fixture(rig));
  const double to_machine = rig.axis == Axis::y ? -1 : 1;  // local y is -X for the Y axis
  int side = 0;
  for (const FixtureProbe& probe : fixture.probes) {
    if (std::abs(probe.n_C.y()) < kAcross) continue;
    const double at = to_machine * probe.plane_offset_m / probe.n_C.y();
    const int of_this = at > 0 ? 1 : at < 0 ? -1 : 0;
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
                       in_urad(of_y) + " in " + y.source + ": both runs look at one square",
                   remedy);
}

// Slope of the horizontal straightness, EYX for X and EXY for Y: the first named error of both.
struct HorizontalSlope {
  Line line;
  double u_slope_rad = 0;
};

double propagated(const std::vector<double>& x, const std::vector<TargetMean>& series) {
  double mean = 0, sxx = 0, sum = 0;
  for (const double v : x) mean += v / static_cast<double>(x.size());
  for (const double v : x) sxx += (v - mean) * (v - mean);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double term = (x[i] - mean) * series[i].u[0] / sxx;
    sum += term * term;
  }
  return std::sqrt(sum);
}

// Of each run and target: how far its visits lie off the mean of all runs' visits from that side,
// m.
using OffMean = std::map<int, std::map<int, std::vector<double>>>;

OffMean off_the_mean(const MovingAxis& moving, const std::vector<MeasuredPoint>& points) {
  const auto value = [&](const MeasuredPoint& p) {
    return named_from_local(moving, p.errors.local)[0];
  };
  struct Mean {
    double sum = 0, n = 0;
  };
  std::map<std::pair<int, int>, Mean> means;  // by target and direction
  for (const MeasuredPoint& p : points) {
    Mean& mean = means[{p.target, p.point.direction}];
    mean.sum += value(p);
    mean.n += 1;
  }
  OffMean off;
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

// s/√n of the slopes of the runs that have at least three targets and half of all; 0 for fewer
// than two such runs. A slope is fitted to what differs from the mean of the runs: the axis' form
// and backlash do not scatter, and a run that lacks a target must not make it seem so.
double scatter_of_runs(const MovingAxis& moving, const std::vector<MeasuredPoint>& points) {
  std::map<int, double> travel_m;  // by target
  for (const MeasuredPoint& p : points)
    travel_m.emplace(p.target, moving.sides.own_travel_m(p.point.position_m));
  std::vector<double> slopes;
  for (const auto& [run, targets] : off_the_mean(moving, points)) {
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

Status check_axis(const Run& run, Axis axis) {
  if (run.header.axis == axis) return {};
  return bad_input("run " + std::to_string(run.header.id) + " is of axis " +
                   letter(run.header.axis) + ", squareness needs the run of " + letter(axis) +
                   " in this place: squareness RUN_X RUN_Y");
}

Result<HorizontalSlope> horizontal_slope(const Run& measured) {
  const Run run = restate(measured, kAtFixture);
  const auto series = target_means(run.header.moving(), run.points, Approach::both);
  const auto x = own_travels(run.header.sides, series);
  if (series.size() < 3 || !can_fit(x)) {
    return bad_input("run " + std::to_string(run.header.id) + " has " +
                     std::to_string(series.size()) +
                     " solved targets; a line with its uncertainty needs at least three");
  }
  HorizontalSlope slope;
  slope.line = least_squares_line(x, column(series, 0));
  slope.u_slope_rad =
      std::max(propagated(x, series),
               scatter_of_runs(run.header.moving(), without_drift_of_runs(run.points).points));
  return slope;
}

constexpr double kMostArtefact_rad = 0.01;  // more is no square

Status check_given(const ArtefactGiven& given) {
  const double angle_rad = given.angle_error_rad.value_or(0), u_rad = given.u_rad.value_or(0);
  if (!(std::abs(angle_rad) <= kMostArtefact_rad))
    return bad_input("the angle error of the square must be from -10000 to 10000 urad");
  if (!(u_rad >= 0 && u_rad <= kMostArtefact_rad))
    return bad_input("the standard uncertainty of the square's angle must be from 0 to 10000 urad");
  return {};
}

}  // namespace

Result<SquareArtefact> artefact_of(const Rig& rig_x, const Rig& rig_y, const ArtefactGiven& given) {
  constexpr const char* kAngle = "artefact_angle_error_urad";
  MDOF_CHECK(check_given(given));
  SquareArtefact artefact;
  const auto x = rig_x.artefact_angle_error_rad, y = rig_y.artefact_angle_error_rad;
  if (!given.angle_error_rad && x && y && *x != *y)
    return contradiction(rig_x, rig_y, kAngle, *x, *y, Remedy::choose_artefact_angle);
  artefact.angle_error_rad = given.angle_error_rad.value_or(x.value_or(y.value_or(0)));
  const double u_x = rig_x.u_artefact_angle_rad, u_y = rig_y.u_artefact_angle_rad;
  if (!given.u_rad && u_x > 0 && u_y > 0 && u_x != u_y)
    return contradiction(rig_x, rig_y, "u_artefact_angle_urad", u_x, u_y,
                         Remedy::choose_artefact_u);
  artefact.u_rad = given.u_rad.value_or(std::max(u_x, u_y));
  MDOF_TRY(const int face_x, side_of_face(rig_x));
  MDOF_TRY(const int face_y, side_of_face(rig_y));
  artefact.corner = face_x * face_y;
  if (artefact.angle_error_rad == 0 || artefact.corner != 0) return artefact;
  const Rig& unclear = face_x == 0 ? rig_x : rig_y;
  return bad_input(unclear.source +
                   ": its side probes do not show on which side of the fixture the face of the "
                   "square lies, so that the sign of " +
                   kAngle +
                   " is not known; give the face's place in position_mm of the side probes, or as "
                   "offset_mm of its [[plane]]");
}

Result<Squareness> squareness(const Run& run_x, const Run& run_y, const SquareArtefact& artefact,
                              bool take_partial) {
  MDOF_CHECK(check_axis(run_x, Axis::x));
  MDOF_CHECK(check_axis(run_y, Axis::y));
  MDOF_CHECK(check_usable({&run_x, &run_y}, take_partial, "squareness"));
  MDOF_TRY(const HorizontalSlope along_x, horizontal_slope(run_x));
  MDOF_TRY(const HorizontalSlope along_y, horizontal_slope(run_y));
  Squareness s;
  s.run_x = run_x.header.id;
  s.run_y = run_y.header.id;
  s.slope_EYX_rad = along_x.line.slope;
  s.u_slope_EYX_rad = along_x.u_slope_rad;
  s.slope_EXY_rad = along_y.line.slope;
  s.u_slope_EXY_rad = along_y.u_slope_rad;
  s.artefact = artefact;
  s.EC0Y_rad =
      -along_y.line.slope - along_x.line.slope + artefact.corner * artefact.angle_error_rad;
  s.u_EC0Y_rad = std::sqrt(s.u_slope_EYX_rad * s.u_slope_EYX_rad +
                           s.u_slope_EXY_rad * s.u_slope_EXY_rad + artefact.u_rad * artefact.u_rad);
  s.form_rad = std::sqrt(along_x.line.u_slope * along_x.line.u_slope +
                         along_y.line.u_slope * along_y.line.u_slope);
  s.simulated = run_x.header.simulated || run_y.header.simulated;
  return s;
}

}  // namespace mdof::algo
