#include "daemon/measure/corrections/point_corrections.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "algo/points/flags.h"
#include "schema/base/number/number_text.h"
#include "schema/units.h"

namespace mdof::daemon {
namespace {

bool tilts_everywhere(const RigPhysics& physics) {
  return std::all_of(physics.probes.begin(), physics.probes.end(),
                     [](const ProbePhysics& p) { return p.tilts(); });
}

// The channel of the first flag of this kind, or nullopt.
std::optional<std::string> channel_of(const Point& point, Flag flag) {
  for (const PointFlag& of : point.flags)
    if (of.flag == flag) return of.channel;
  return std::nullopt;
}

// The points of `before` that are in the run.
std::vector<const Point*> kept(const std::vector<Point>& before, const Run& run) {
  std::set<std::int64_t> begins_ns;
  for (const MeasuredPoint& p : run.points) begins_ns.insert(p.point.begin_ns);
  std::vector<const Point*> points;
  for (const Point& point : before)
    if (begins_ns.contains(point.begin_ns)) points.push_back(&point);
  return points;
}

// Linearity correction of a displacement along the direction `measures` of the probe, in m.
// `includes_linearity`: the displacement contains this correction already.
double linearity_correction_m(const Calibration& c, double displacement_m,
                              bool includes_linearity) {
  const double sign = c.reads_gap ? -1 : 1;
  const double t_um = sign * to_um(displacement_m);
  double correction_um = linearity_um(c, t_um);
  for (int i = 0; includes_linearity && i < 5; ++i)
    correction_um = linearity_um(c, t_um - correction_um);
  return sign * from_um(correction_um);
}

std::string closed_gap_text(const std::string& probe) {
  return "the gap of probe " + probe +
         " is closed according to standoff_um and sensing_radius_mm; ";
}

}  // namespace

void LargestChange::add(double change_m, const std::string& of_probe) {
  if (!(std::abs(change_m) > size_m)) return;
  size_m = std::abs(change_m);
  probe = of_probe;
}

Notice change_notice(const char* what, bool corrected, const LargestChange& change) {
  return notice(corrected ? NoticeCode::reading_corrected : NoticeCode::reading_not_corrected, what,
                {{"size_nm", to_um(change.size_m) * 1e3}, {"probe", change.probe}});
}

PointCorrections::PointCorrections(Rig rig) : rig_(std::move(rig)) {
  if (!rig_.physics) return;
  const RigPhysics& physics = *rig_.physics;
  asked_ = {physics.tilt, physics.dielectric};
  known_ = {tilts_everywhere(physics), physics.has_known_air_effect()};
  if (physics.air) air_.emplace(*physics.air);
}

void PointCorrections::push(const SampleBlock& raw) {
  if (air_) air_->push(raw);
}

std::optional<Air> PointCorrections::air_at(const Point& point) const {
  return air_ ? air_->at(point.begin_ns + (point.end_ns - point.begin_ns) / 2) : std::nullopt;
}

void PointCorrections::apply(const algo::Solver& solver, std::vector<Point>& points) const {
  if (!asked_.any()) return;
  const algo::ReadingCorrection correction(rig_, solver, asked_);
  for (Point& point : points) correct(correction, point);
}

void PointCorrections::correct(const algo::ReadingCorrection& correction, Point& point) const {
  const auto air = air_at(point);
  if (asked_.dielectric && !air) {
    algo::add_flag(point, Flag::no_air);
    point.probe_m.assign(point.probe_m.size(), kNaN);
    return;
  }
  const auto corrected = correction.correct(rig_.sides.target_travel_m(point.position_m),
                                            point.probe_m, point.probe_u_m, air.value_or(Air{}));
  if (!corrected.why_not.empty())
    algo::add_flag(point, Flag::gap_closed,
                   corrected.closed ? rig_.probes[*corrected.closed].id : "?");
  point.probe_m = corrected.readings_m;
}

PointCorrections::Changes PointCorrections::changes(const algo::Solver& solver,
                                                    algo::WhichCorrections which,
                                                    const std::vector<const Point*>& points) const {
  Changes most;
  if (!which.any()) return most;
  const algo::ReadingCorrection correction(rig_, solver, which);
  for (const Point* point : points) {
    const auto air = air_at(*point);
    if (which.dielectric && !air) continue;
    const auto corrected =
        correction.correct(rig_.sides.target_travel_m(point->position_m), point->probe_m,
                           point->probe_u_m, air.value_or(Air{}));
    if (!corrected.why_not.empty()) continue;
    for (std::size_t k = 0; k < rig_.probes.size(); ++k) {
      most.tilt.add(corrected.tilt_m[k], rig_.probes[k].id);
      most.dielectric.add(corrected.dielectric_m[k], rig_.probes[k].id);
    }
  }
  return most;
}

LargestChange PointCorrections::linearity(const std::vector<const Point*>& points) const {
  const auto& left_out = rig_.physics->left_out;
  LargestChange most;
  for (const Point* point : points)
    for (std::size_t k = 0; k < rig_.probes.size(); ++k) {
      const bool includes_linearity = left_out.empty();
      const Calibration& c = includes_linearity ? rig_.probes[k].calibration : *left_out[k];
      most.add(linearity_correction_m(c, point->probe_m[k], includes_linearity), rig_.probes[k].id);
    }
  return most;
}

void PointCorrections::report(const algo::Solver& solver, const std::vector<Point>& before,
                              Run& run) const {
  if (!rig_.physics) return;
  const auto points = kept(before, run);
  Notices& notices = run.header.notices;
  const LargestChange linear = linearity(points);
  if (rig_.physics->linearity || linear.size_m > 0)
    notices.push_back(change_notice("linearity", rig_.physics->left_out.empty(), linear));
  const Changes made = changes(solver, asked_, points);
  const algo::WhichCorrections left{known_.tilt && !asked_.tilt,
                                    known_.dielectric && !asked_.dielectric};
  const Changes not_made = changes(solver, left, points);
  if (asked_.tilt) {
    notices.push_back(change_notice("tilt", true, made.tilt));
    notices.push_back(notice(NoticeCode::tilt_since_zero));
  }
  if (left.tilt) notices.push_back(change_notice("tilt", false, not_made.tilt));
  if (asked_.dielectric) notices.push_back(change_notice("dielectric", true, made.dielectric));
  if (left.dielectric && not_made.dielectric.size_m > 0)
    notices.push_back(change_notice("dielectric", false, not_made.dielectric));
  report_air(run);
  report_failures(run);
}

// The notice contains the ambient conditions at the first and at the last point, because the
// conditions can change during the run.
void PointCorrections::report_air(Run& run) const {
  if (!known_.dielectric || run.points.empty()) return;
  const auto first = air_at(run.points.front().point), last = air_at(run.points.back().point);
  if (!first || !last) return;
  std::string conditions;
  for (std::size_t q = 0; q < kAirQuantities; ++q) {
    const std::string from = plain_number((*first)[q]), to = plain_number((*last)[q]);
    conditions += std::string(q == 0 ? "" : ", ") + from + (from == to ? "" : " to " + to) + " " +
                  air_quantities()[q].unit;
  }
  run.header.notices.push_back(notice(NoticeCode::air_of_run, "", {{"conditions", conditions}}));
}

void PointCorrections::report_failures(Run& run) const {
  std::size_t closed = 0, without_air = 0;
  std::string first;
  for (const MeasuredPoint& p : run.points) {
    without_air += algo::has_flag(p.point, Flag::no_air) ? 1 : 0;
    const auto probe = channel_of(p.point, Flag::gap_closed);
    if (probe && closed++ == 0) first = closed_gap_text(*probe);
  }
  if (closed > 0)
    run.header.notices.push_back(
        notice(NoticeCode::gap_closed, "", {{"points", closed}, {"first", first}}));
  if (without_air > 0)
    run.header.notices.push_back(notice(NoticeCode::air_unknown, "", {{"points", without_air}}));
}

// Reads the cause from the flags of the point, because the solver states only that a reading is
// missing.
std::string cause_of(const Point& point) {
  if (const auto frozen = channel_of(point, Flag::frozen))
    return "probe " + *frozen + " no longer changes; ";
  if (const auto closed = channel_of(point, Flag::gap_closed)) return closed_gap_text(*closed);
  for (const PointFlag& flag : point.flags)
    if (flag.flag == Flag::lost && algo::has_flag(point, Flag::saturated, flag.channel))
      return "probe " + flag.channel + " is at the end of its range; ";
  if (algo::has_flag(point, Flag::no_air)) return "the ambient conditions are unknown; ";
  return "";
}

}  // namespace mdof::daemon
