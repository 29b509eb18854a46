#include "daemon/measure/replay/radial_scan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "algo/compensation/between_targets.h"
#include "algo/form/map_figures.h"
#include "algo/form/scan_map.h"
#include "algo/model/moving_body.h"
#include "algo/model/restate.h"
#include "algo/points/dwell.h"
#include "algo/points/motion_trace.h"
#include "daemon/measure/evaluation.h"
#include "daemon/measure/forward_model.h"
#include "daemon/measure/replay/replay.h"
#include "drivers/calibration.h"
#include "schema/rig/scan.h"
#include "schema/units.h"

namespace mdof::daemon {
namespace {

constexpr std::chrono::milliseconds kScanTimeout{1000};
constexpr std::int64_t kMostGap_ns =
    50'000'000;  // longest gap of the encoder or the angle that is interpolated
constexpr std::size_t kMostScanPoints = 50'000'000;
constexpr double kDefaultPixels = 100, kTurn_deg = 360;

// The values of one column in the order of time.
struct Series {
  std::vector<std::int64_t> time_ns;
  std::vector<double> value;

  void take(std::int64_t t, double x) {
    if (!std::isfinite(x)) return;
    time_ns.push_back(t);
    value.push_back(x);
  }
  // The value at the time t, interpolated linearly. NaN outside the series and in a long gap.
  double at(std::int64_t t) const {
    const auto after = std::lower_bound(time_ns.begin(), time_ns.end(), t);
    if (after == time_ns.end()) return kNaN;
    const auto i = static_cast<std::size_t>(after - time_ns.begin());
    if (*after == t) return value[i];
    if (i == 0 || *after - time_ns[i - 1] > kMostGap_ns) return kNaN;
    const double part =
        static_cast<double>(t - time_ns[i - 1]) / static_cast<double>(time_ns[i] - time_ns[i - 1]);
    return value[i - 1] + part * (value[i] - value[i - 1]);
  }
  // Removes the steps of 360 degrees from an angle. Interpolation between 359 and 1 degrees is then
  // correct.
  void make_continuous() {
    for (std::size_t i = 1; i < value.size(); ++i)
      value[i] = value[i - 1] + std::remainder(value[i] - value[i - 1], kTurn_deg);
  }
};

struct Columns {
  Series encoder_m, angle_deg, height_m;
};

Result<double> length_unit(const Channel& channel, const std::string& log) {
  if (channel.unit == Unit::um) return from_um(1);
  if (channel.unit == Unit::mm) return from_mm(1);
  return bad_input(log + ": the column of the scanning probe " + channel.id +
                   " must have the name " + channel.id + "_um or " + channel.id + "_mm");
}

Status take_block(SampleBlock& block, const RigScan& scan, const std::string& log,
                  Columns& columns) {
  for (std::size_t c = 0; c < block.channels.size(); ++c) {
    const Channel& channel = block.channels[c];
    Series* const to = channel.id == kEncoderChannel ? &columns.encoder_m
                       : channel.id == scan.angle    ? &columns.angle_deg
                       : channel.id == scan.probe    ? &columns.height_m
                                                     : nullptr;
    if (!to) continue;
    double unit = 1;
    std::int64_t delay_ns = 0;
    if (channel.id == scan.probe) {
      MDOF_TRY(unit, length_unit(channel, log));
      delay_ns = std::llround(scan.delay_s * 1e9);
    }
    for (std::size_t i = 0; i < block.scans(); ++i)
      if (usable(block.quality_at(c, i)))
        to->take(block.time_ns[i] - delay_ns, unit * block.value[c][i]);
  }
  return {};
}

Result<Columns> read_columns(const RunHeader& run, const Rig& rig, const RigScan& scan) {
  const Provenance& from = run.provenance;
  MDOF_TRY(ReplayLog log, ReplayLog::open(from.recording_path));
  const drivers::Calibrator calibrator(rig);
  Columns columns;
  SampleBlock block;
  for (;;) {
    MDOF_TRY(const auto state, log.driver().read(block, kScanTimeout));
    if (block.scans() > 0) {
      MDOF_CHECK(calibrator.apply(block));
      MDOF_CHECK(take_block(block, scan, from.recording_path, columns));
      if (columns.height_m.value.size() > kMostScanPoints)
        return bad_input(from.recording_path + ": the scan has more than " +
                         std::to_string(kMostScanPoints) +
                         " height values (limit of a log); divide the scan into several runs");
    }
    if (state == drivers::ReadState::end) break;
  }
  if (log.sha256() != from.recording_sha256)
    return bad_input(from.recording_path + ": this log was changed after run " +
                     std::to_string(run.id) + " was calculated from it; replay the log again");
  for (const auto& [name, series] :
       {std::pair(scan.probe, &columns.height_m), std::pair(scan.angle, &columns.angle_deg)})
    if (series->value.empty())
      return bad_input(from.recording_path + ": the column " + name +
                       " (named in [scan] of the rig) is missing or has no value");
  columns.angle_deg.make_continuous();
  return columns;
}

// Direction of the axis at the times of a run.
class Directions {
 public:
  // Within a stop, the direction is the approach of its point. Elsewhere, the axis has turned if it
  // moved back by the travel that determines the approach of a stop. Before the first motion, the
  // direction is the approach of the first stop.
  Directions(const std::vector<MeasuredPoint>& points, const Series& encoder_m) {
    for (const MeasuredPoint& p : points)
      stops_.push_back({p.point.begin_ns, p.point.end_ns, p.point.direction});
    std::sort(stops_.begin(), stops_.end(),
              [](const Stop& a, const Stop& b) { return a.begin_ns < b.begin_ns; });
    algo::MotionTrace trace;
    int direction = stops_.empty() ? 0 : stops_.front().direction;
    turns_.emplace_back(std::numeric_limits<std::int64_t>::min(), direction);
    for (std::size_t i = 0; i < encoder_m.value.size(); ++i) {
      trace.follow(encoder_m.value[i], algo::DwellOptions{}.approach_m);
      if (trace.heading() == 0 || trace.heading() == direction) continue;
      direction = trace.heading();
      turns_.emplace_back(encoder_m.time_ns[i], direction);
    }
  }
  int at(std::int64_t t) const {
    const auto stop = std::upper_bound(
        stops_.begin(), stops_.end(), t,
        [](std::int64_t time_ns, const Stop& each) { return time_ns < each.begin_ns; });
    if (stop != stops_.begin() && t <= std::prev(stop)->end_ns) return std::prev(stop)->direction;
    return std::prev(std::upper_bound(turns_.begin(), turns_.end(), t,
                                      [](std::int64_t time_ns, const auto& turn) {
                                        return time_ns < turn.first;
                                      }))
        ->second;
  }

 private:
  struct Stop {
    std::int64_t begin_ns = 0, end_ns = 0;
    int direction = 0;
  };
  std::vector<Stop> stops_;
  std::vector<std::pair<std::int64_t, int>> turns_;  // time, new direction
};

// Readings of the scanning probe that the errors of the axis cause, at the targets of the run that
// the axis approached in one direction. Empty: too few targets.
struct Motion {
  std::vector<double> position_m, reading_m, u_m;
  std::vector<double> curvature;  // in each interval, of reading_m

  struct Value {
    double reading_m = 0, u_m = 0, u_between_m = 0;
  };
  bool holds(double at_m) const {
    return !position_m.empty() && at_m >= position_m.front() && at_m <= position_m.back();
  }
  // `at_m`: holds() is true. Linear between targets, like compensation.at.
  Value at(double at_m) const {
    const auto after = std::lower_bound(position_m.begin() + 1, position_m.end(), at_m);
    const auto i = static_cast<std::size_t>(after - position_m.begin());
    const double before_m = at_m - position_m[i - 1], behind_m = position_m[i] - at_m;
    const double part = before_m / (position_m[i] - position_m[i - 1]);
    return {reading_m[i - 1] + part * (reading_m[i] - reading_m[i - 1]),
            u_m[i - 1] + part * (u_m[i] - u_m[i - 1]),
            0.5 * before_m * behind_m * curvature[i - 1]};
  }
};

struct Motions {
  Motion forward, reverse;
  const Motion& of(int direction) const { return direction < 0 ? reverse : forward; }
};

// The rig with the scanning probe as its only probe. The rig has no planes, so the probe measures a
// plane that is perpendicular to the direction of the probe.
Rig with_scanning_probe(Rig rig, const RigScan& scan) {
  rig.planes.clear();
  rig.probes.assign(1, {});
  rig.probes[0].id = scan.probe;
  rig.probes[0].position_m = scan.position_m;
  rig.probes[0].direction = scan.direction;
  return rig;
}

// Variance of the reading from the covariance of the five errors. The reading is a linear function
// of the errors.
double reading_variance(const drivers::ForwardModel& model, double travel_m,
                        const AxisErrors& errors) {
  std::array<double, 5> slope{};
  double without_m = 0;
  model(travel_m, Errors5{}, {&without_m, 1});
  for (std::size_t k = 0; k < 5; ++k) {
    Errors5 one{};
    one[k] = 1e-6;
    model(travel_m, one, {&slope[k], 1});
    slope[k] = (slope[k] - without_m) / 1e-6;
  }
  double variance = 0;
  for (std::size_t i = 0; i < 5; ++i)
    for (std::size_t k = 0; k < 5; ++k)
      variance += slope[i] * errors.covariance[5 * i + k] * slope[k];
  return variance;
}

// The errors between two targets are uncertain by their curvature, which needs three targets.
constexpr std::size_t kLeastTargets = 3;

Result<Motion> motion_of(const Run& run, const Rig& rig, const RigScan& scan, int direction) {
  MDOF_TRY(const auto model, forward_model(with_scanning_probe(rig, scan)));
  struct Sum {
    double n = 0, position_m = 0, reading_m = 0, variance = 0;
  };
  std::map<int, Sum> targets;
  double read_m = 0;
  const Model solved = algo::model_of(run);
  for (const MeasuredPoint& p : run.points) {
    if (!p.errors.valid || p.point.direction != direction) continue;
    const AxisErrors of_target = algo::errors_of_target(p.errors, solved, run.header.moving());
    model(rig.sides.target_travel_m(p.point.position_m), of_target.local, {&read_m, 1});
    Sum& sum = targets[p.target];
    sum.n += 1;
    sum.position_m += p.point.position_m;
    sum.reading_m += read_m;
    sum.variance +=
        reading_variance(model, rig.sides.target_travel_m(p.point.position_m), p.errors);
  }
  Motion motion;
  if (targets.size() < kLeastTargets) return motion;
  std::vector<Sum> sorted;
  for (const auto& [target, sum] : targets) sorted.push_back(sum);
  std::sort(sorted.begin(), sorted.end(),
            [](const Sum& a, const Sum& b) { return a.position_m / a.n < b.position_m / b.n; });
  for (const Sum& sum : sorted) {
    motion.position_m.push_back(sum.position_m / sum.n);
    motion.reading_m.push_back(sum.reading_m / sum.n);
    motion.u_m.push_back(std::sqrt(sum.variance) / sum.n);
  }
  motion.curvature = algo::curvatures(motion.position_m, motion.reading_m, motion.u_m);
  return motion;
}

Result<Motions> motions_of(const Run& run, const Rig& rig, const RigScan& scan) {
  Motions motions;
  MDOF_TRY(motions.forward, motion_of(run, rig, scan, 1));
  MDOF_TRY(motions.reverse, motion_of(run, rig, scan, -1));
  if (!motions.forward.position_m.empty() || !motions.reverse.position_m.empty()) return motions;
  return bad_input("run " + std::to_string(run.header.id) +
                   ": fewer than three targets that were approached in the same direction have "
                   "error values, but a scan needs the errors at three or more targets along the "
                   "radius; measure more targets");
}

void add_points(const Columns& columns, const Directions& directions, const Motions& motions,
                const Rig& rig, const RigScan& scan, algo::ScanPoints& points, RadialScan& out) {
  const double centre_m = rig.sides.target_travel_m(scan.centre_m);
  for (std::size_t i = 0; i < columns.height_m.value.size(); ++i) {
    const std::int64_t t = columns.height_m.time_ns[i];
    const double encoder_m = columns.encoder_m.at(t), angle_deg = columns.angle_deg.at(t);
    if (std::isnan(encoder_m) || std::isnan(angle_deg)) {
      ++out.unplaced_heights;
      continue;
    }
    const Motion& motion = motions.of(directions.at(t));
    if (!motion.holds(encoder_m)) {
      ++(motion.position_m.empty() ? out.other_direction : out.beyond_targets);
      continue;
    }
    // When the target moves towards +, the probe moves towards - relative to the axis of the
    // spindle.
    const double rho_m = centre_m - rig.sides.target_travel_m(encoder_m);
    const double angle = scan.sense * angle_deg * std::numbers::pi / 180;
    points.x_m.push_back(rho_m * std::cos(angle));
    points.y_m.push_back(-rho_m * std::sin(angle));
    points.z_m.push_back(columns.height_m.value[i] - motion.at(encoder_m).reading_m);
  }
}

double peak_to_valley_m(const Motions& motions) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const Motion* motion : {&motions.forward, &motions.reverse})
    for (const double reading_m : motion->reading_m) {
      least = std::min(least, reading_m);
      most = std::max(most, reading_m);
    }
  return most - least;
}

// Adds the u of the subtracted errors, RMS over the pixels. A pixel was measured on both sides of
// the axis of the spindle.
void add_u(const Motions& motions, double centre_m, RadialScan& out) {
  double n = 0, at_targets = 0, between = 0;
  for (std::size_t j = 0; j < out.map.ny; ++j)
    for (std::size_t i = 0; i < out.map.nx; ++i) {
      if (std::isnan(out.map.at(i, j))) continue;
      const double rho_m = std::hypot(out.map.x_m(i), out.map.y_m(j));
      for (const double at_m : {centre_m - rho_m, centre_m + rho_m})
        for (const Motion* motion : {&motions.forward, &motions.reverse}) {
          if (!motion->holds(at_m)) continue;
          const Motion::Value value = motion->at(at_m);
          n += 1;
          at_targets += value.u_m * value.u_m;
          between += value.u_between_m * value.u_between_m;
        }
    }
  if (n == 0) return;
  out.u_motion_m = std::max(out.u_motion_m, std::sqrt(at_targets / n));
  out.u_between_m = std::max(out.u_between_m, std::sqrt(between / n));
}

struct ScannedRun {
  Motions motions;
  double centre_m = 0;
};

Result<ScannedRun> add_run(store::Store& store, std::int64_t id, algo::ScanPoints& points,
                           RadialScan& out) {
  MDOF_TRY(const Run run, restated_run(store, id, Reference::carriage));
  const std::string name = "run " + std::to_string(id);
  MDOF_TRY(const Rig rig, daemon::rig_of(run.header));
  MDOF_TRY(const auto scan, scan_of_rig(run.header.provenance.rig_text, rig.axis, name));
  if (!scan)
    return bad_input(name +
                     ": this run is not a scan, because its rig has no table [scan]; give a run "
                     "whose rig has [scan]");
  out.simulated = out.simulated || run.header.simulated;
  ScannedRun scanned{{}, scan->centre_m};
  MDOF_TRY(scanned.motions, motions_of(run, rig, *scan));
  out.motion_pv_m = std::max(out.motion_pv_m, peak_to_valley_m(scanned.motions));
  MDOF_TRY(const Columns columns, read_columns(run.header, rig, *scan));
  add_points(columns, Directions(run.points, columns.encoder_m), scanned.motions, rig, *scan,
             points, out);
  return scanned;
}

double default_pixel_m(const algo::ScanPoints& points) {
  double square = 0;
  for (std::size_t i = 0; i < points.x_m.size(); ++i)
    square = std::max(square, points.x_m[i] * points.x_m[i] + points.y_m[i] * points.y_m[i]);
  return 2 * std::sqrt(square) / kDefaultPixels;
}

}  // namespace

Result<RadialScan> radial_scan(store::Store& store, const std::vector<std::int64_t>& runs,
                               std::optional<double> pixel_m) {
  RadialScan out;
  algo::ScanPoints points;
  std::vector<ScannedRun> scanned;
  std::string name;
  for (const std::int64_t id : runs) {
    MDOF_TRY(scanned.emplace_back(), add_run(store, id, points, out));
    name += (name.empty() ? "run " : ", ") + std::to_string(id);
  }
  out.points = points.z_m.size();
  out.pixel_m = pixel_m ? *pixel_m : default_pixel_m(points);
  auto scan = algo::scan_map(points, out.pixel_m);
  if (!scan) return in_context(name, std::move(scan.error()));
  out.map = std::move(scan->map);
  const algo::MapFigures u = algo::figures_of(scan->u);
  out.u_noise_m = std::hypot(u.rms_m, u.mean_m);
  for (const ScannedRun& run : scanned) add_u(run.motions, run.centre_m, out);
  out.map.name = name;
  return out;
}

}  // namespace mdof::daemon
