#include "algo/calibration/sensitivity.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "algo/iso230/line_fit.h"
#include "algo/model/fixture.h"
#include "schema/base/number/number_text.h"
#include "schema/rig/effects/physics.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

constexpr std::size_t kFewest = 3;
constexpr double kShortest = 0.05;           // smallest range of the readings, relative to the
                                             // range of the probe
constexpr double kLeast = 0.5, kMost = 2;    // limits of the sensitivity g
constexpr double kSamePositionShare = 1e-3;  // relative to the range; nearer stops are one position

// Displacement along the direction of the probe for a travel of 1 m along the axis.
Result<double> facing(const Rig& rig, std::size_t probe, Axis axis) {
  MDOF_TRY(const Fixture fixture, make_fixture(rig));
  const FixtureProbe& p = fixture.probes[probe];
  Vec3 machine{};
  machine[static_cast<std::size_t>(axis)] = 1;
  const Vec3 way = to_local(rig.axis, machine);
  return p.n_C.dot(Eigen::Vector3d(way[0], way[1], way[2])) / p.n_C.dot(p.u_M);
}

struct Reading {
  double true_m, read_m, u_m;
};

// Groups the readings by their true displacement, ascending. A reading belongs to a group if its
// distance from the first reading of the group is at most `apart_m` or a fifth of the mean step,
// whichever is larger.
std::vector<std::vector<Reading>> group_by_position(std::vector<Reading> all, double apart_m) {
  std::sort(all.begin(), all.end(),
            [](const Reading& a, const Reading& b) { return a.true_m < b.true_m; });
  if (all.size() < 2) return std::vector<std::vector<Reading>>(all.size(), all);
  const double span_m = all.back().true_m - all.front().true_m;
  apart_m = std::max(apart_m, 0.2 * span_m / static_cast<double>(all.size() - 1));
  std::vector<std::vector<Reading>> places;
  for (const Reading& reading : all) {
    if (places.empty() || reading.true_m - places.back().front().true_m > apart_m)
      places.emplace_back();
    places.back().push_back(reading);
  }
  return places;
}

struct SlopeUncertainty {
  double u = 0, freedom = std::numeric_limits<double>::infinity();
};

// `u_encoder_m`: u of the encoder, converted to a displacement along the probe.
SlopeUncertainty slope_uncertainty(const std::vector<std::vector<Reading>>& places, double slope,
                                   double u_encoder_m) {
  double n = 0, mean = 0, square = 0;
  for (const auto& place : places)
    for (const Reading& visit : place) {
      n += 1;
      mean += visit.true_m;
    }
  mean /= n;
  for (const auto& place : places)
    for (const Reading& visit : place) square += (visit.true_m - mean) * (visit.true_m - mean);
  double variance = 0;
  std::vector<double> x, y;
  for (const auto& place : places) {
    double lever = 0, true_m = 0, read_m = 0;
    const auto visits = static_cast<double>(place.size());
    for (const Reading& visit : place) {
      const double of_visit = (visit.true_m - mean) / square;
      lever += of_visit;
      variance += of_visit * of_visit * visit.u_m * visit.u_m;
      true_m += visit.true_m / visits;
      read_m += visit.read_m / visits;
    }
    variance += lever * lever * slope * slope * u_encoder_m * u_encoder_m;
    x.push_back(true_m - mean);
    y.push_back(read_m);
  }
  const double u_left = x.size() > 2 ? least_squares_line(x, y).u_slope : 0;
  if (u_left * u_left <= variance) return {std::sqrt(variance)};
  return {u_left, static_cast<double>(x.size()) - 2};
}

std::vector<std::string> undetectable_effects(const Rig& rig) {
  std::vector<std::string> sentences = {
      "the scale error of the encoder, which the calibrated sensitivity therefore contains",
      "the product of two angles: the squareness error of the axis to the plane, and the tilt of "
      "the target. For example, angles of 1 mrad and 5 mrad change the sensitivity by 5 ppm"};
  if (!rig.uncertainty.encoder.declared())
    sentences.insert(sentences.begin(),
                     "encoder errors that repeat at the same position: the rig does not declare "
                     "[encoder] u_um, so u includes only the part of these errors that is visible "
                     "in the residuals of the fitted line");
  return sentences;
}

// The mean of the readings of each position.
std::vector<Reading> means_of(const std::vector<std::vector<Reading>>& places) {
  std::vector<Reading> means;
  for (const auto& place : places) {
    Reading sum{0, 0, 0};
    for (const Reading& visit : place) {
      sum.true_m += visit.true_m;
      sum.read_m += visit.read_m;
    }
    const auto n = static_cast<double>(place.size());
    means.push_back({sum.true_m / n, sum.read_m / n, 0});
  }
  return means;
}

// Largest difference between the readings of one position, without the differences of their travel.
double largest_difference(const std::vector<std::vector<Reading>>& places, double slope) {
  double largest = 0;
  for (const auto& place : places) {
    const auto [low, high] = std::minmax_element(
        place.begin(), place.end(), [slope](const Reading& a, const Reading& b) {
          return a.read_m - slope * a.true_m < b.read_m - slope * b.true_m;
        });
    largest = std::max(largest, high->read_m - low->read_m - slope * (high->true_m - low->true_m));
  }
  return largest;
}

// Refuses a step in which the reading hardly changes, or changes too much: the line through all
// stops can hide such a step.
Status check_steps(const Probe& probe, const std::vector<Reading>& means) {
  const double slack_m = kSamePositionShare * probe.range_m;
  for (std::size_t i = 1; i < means.size(); ++i) {
    const double step_m = means[i].true_m - means[i - 1].true_m;
    const double change_m = means[i].read_m - means[i - 1].read_m;
    if (change_m >= kLeast * step_m - slack_m && change_m <= kMost * step_m + slack_m) continue;
    return fail(ErrorCode::check,
                "probe \"" + probe.id + "\": the reading changes by " +
                    plain_number(to_um(change_m), 4) + " um in a step of " +
                    plain_number(to_um(step_m), 4) + " um, from the reading " +
                    plain_number(to_um(means[i - 1].read_m), 4) +
                    " um (limits: " + plain_number(kLeast, 3) + " and " + plain_number(kMost, 3) +
                    " times the step). The probe is at the end of its range, or the target did not "
                    "move. Measure only at positions at which the reading follows the target");
  }
  return {};
}

Status check(const Probe& probe, const Line& line) {
  if (line.slope >= kLeast && line.slope <= kMost) return {};
  const std::string wrong = "probe \"" + probe.id + "\": the reading changes by " +
                            plain_number(line.slope, 4) + " um for 1 um of travel (limits " +
                            plain_number(kLeast, 3) + " and " + plain_number(kMost, 3) + ")";
  if (line.slope < 0)
    return fail(ErrorCode::check,
                wrong + "; check the keys \"reads\" and \"measures\" of this probe in the rig",
                Remedy::reverse_target);
  return fail(ErrorCode::check, wrong + "; check um_per_V in the rig and the unit of the encoder");
}

// Extends the corrections to the ends of the range. Without the extension, the correction outside
// the table is constant, although an error of the sensitivity acts at every reading. `slope`: slope
// of the correction.
void extend_to_range(const Probe& probe, double slope, SensitivityCalibration& found) {
  const auto [low_um, high_um] = readings_of_range(probe);
  auto& table = found.linearity;
  const auto [first_um, first_correction_um] = table.front();
  const auto [last_um, last_correction_um] = table.back();
  if (low_um < first_um)
    table.insert(table.begin(), {low_um, first_correction_um + slope * (low_um - first_um)});
  if (high_um > last_um)
    table.push_back({high_um, last_correction_um + slope * (high_um - last_um)});
}

// Sets the proposed values of the rig. If the rig has um_per_V, the sensitivity is included in
// um_per_V, and the table contains only the nonlinearity. Otherwise the table contains both.
void propose(const Probe& probe, const std::vector<Reading>& means, const Line& line,
             SensitivityCalibration& found) {
  const Calibration& c = probe.calibration;
  const double divisor = c.um_per_V ? line.slope : 1;
  if (c.um_per_V) found.um_per_V = *c.um_per_V / divisor;
  found.offset_um = c.offset_um / divisor;
  const double zero_m = line.intercept / line.slope;
  const double sign = c.reads_gap ? -1 : 1;
  for (const Reading& place : means) {
    const double read_m = place.read_m / divisor;
    found.linearity.push_back({sign * to_um(read_m), sign * to_um(place.true_m + zero_m - read_m)});
  }
  std::sort(found.linearity.begin(), found.linearity.end());
  found.calibrated_um = {found.linearity.front()[0], found.linearity.back()[0]};
  if (!c.um_per_V) extend_to_range(probe, 1 / line.slope - 1, found);
}

// Why stops have no reading. A reading outside the range of the probe is not used.
std::string unusable_text(std::size_t unusable, std::size_t stops) {
  if (unusable == 0) return "";
  return "; " + std::to_string(unusable) + " of " + std::to_string(stops) +
         " stops have no usable reading, because the readings are outside the range of the probe "
         "or missing; check the unit of the readings in the log";
}

}  // namespace

Result<Axis> approaching_axis(const Rig& rig, std::size_t probe) {
  Axis best = Axis::x;
  double most = 0;
  for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
    MDOF_TRY(const double along, facing(rig, probe, axis));
    if (std::abs(along) <= most) continue;
    most = std::abs(along);
    best = axis;
  }
  return best;
}

Result<SensitivityCalibration> fit_sensitivity(const Rig& rig, std::size_t probe,
                                               const Traverse& traverse) {
  const Probe& own = rig.probes[probe];
  MDOF_TRY(const double along, facing(rig, probe, traverse.axis));
  std::vector<Reading> all;
  for (const TraverseStop& stop : traverse.stops)
    if (std::isfinite(stop.reading_m[probe]))
      all.push_back({stop.travel_m * along, stop.reading_m[probe], stop.u_reading_m[probe]});
  const auto places = group_by_position(all, kSamePositionShare * own.range_m);
  const std::vector<Reading> means = means_of(places);
  const double way_m = means.empty() ? 0 : std::abs(means.back().read_m - means.front().read_m);
  if (places.size() < kFewest || way_m < kShortest * own.range_m)
    return fail(ErrorCode::check,
                "probe \"" + own.id + "\" has readings at " + std::to_string(places.size()) +
                    " positions over " + plain_number(to_um(way_m)) +
                    " um; measure at three or more positions that cover the part of the range that "
                    "you use (range of the probe: " +
                    plain_number(to_um(own.range_m)) + " um)" +
                    unusable_text(traverse.stops.size() - all.size(), traverse.stops.size()));
  std::vector<double> x, y;
  for (const Reading& reading : all) {
    x.push_back(reading.true_m - all.front().true_m);
    y.push_back(reading.read_m);
  }
  Line line = least_squares_line(x, y);
  line.intercept -= line.slope * all.front().true_m;
  MDOF_CHECK(check(own, line));
  MDOF_CHECK(check_steps(own, means));
  SensitivityCalibration found;
  found.id = own.id;
  found.sensitivity_1 = line.slope;
  const SlopeUncertainty u =
      slope_uncertainty(places, line.slope, std::abs(along) * rig.uncertainty.encoder.u);
  found.u_sensitivity_1 = u.u;
  found.freedom = u.freedom;
  found.not_seen = undetectable_effects(rig);
  const double difference_m = largest_difference(places, line.slope);
  if (difference_m > kSamePositionShare * own.range_m)
    found.not_seen.push_back("the differences of up to " + plain_number(to_um(difference_m), 3) +
                             " um between stops at the same position (backlash of the encoder, or "
                             "drift): the linearity contains the mean of these stops");
  found.residual_sd_m = line.residual_sd;
  found.from_m = means.front().read_m;
  found.to_m = means.back().read_m;
  found.stops = all.size();
  for (const Reading& reading : all)
    found.linearity_m =
        std::max(found.linearity_m, std::abs(reading.read_m - line.at(reading.true_m)));
  propose(own, means, line, found);
  return found;
}

}  // namespace mdof::algo
