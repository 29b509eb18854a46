#include "algo/uncertainty/point_sensitivity.h"

#include <cmath>

#include "algo/model/restate.h"
#include "algo/model/rigid.h"
#include "algo/uncertainty/statistics/local_slopes.h"

namespace mdof::algo {
namespace {

// Steps of the central differences. They are so small that the curvature by an error of 1 mrad
// changes the difference only by 1e-6, and large compared with the rounding error of a position of
// 0.1 m.
constexpr double kReadingStep_m = 1e-7, kTravelStep_m = 1e-5;

class Differences {
 public:
  Differences(const Solver& solver, const Run& run, const MeasuredPoint& p)
      : solver_(solver), run_(run), p_(p) {}

  PointSensitivity take() {
    PointSensitivity s;
    s.by_probe.resize(p_.point.probe_m.size());
    s.travel_m = run_.header.sides.target_travel_m(p_.point.position_m);
    const AxisErrors carriage =
        solver_.solve_without_covariance(s.travel_m, p_.point.probe_m, p_.point.probe_u_m);
    s.valid = p_.errors.valid && carriage.valid;
    if (!s.valid) return s;
    s.carriage = carriage.local;
    const Eigen::MatrixXd gain =
        solver_.gain(s.travel_m, carriage, p_.point.probe_m, p_.point.probe_u_m);
    for (std::size_t k = 0; k < s.by_probe.size(); ++k)
      if (std::isfinite(p_.point.probe_m[k]))
        s.by_probe[k] = by_reading(carriage, s.travel_m, gain.col(static_cast<Eigen::Index>(k)));
    s.by_travel = solver_.model() == Model::rigid ? by_travel(carriage, s.travel_m, gain)
                                                  : by_travel(s.travel_m);
    return s;
  }

 private:
  Errors5 stated(const AxisErrors& carriage, double travel_m) const {
    return restate(carriage, solver_.model(), {run_.header.axis, {}}, travel_m, kAtCarriage,
                   run_.header.stated)
        .local;
  }
  static Errors5 slope(const Errors5& above, const Errors5& below, double step) {
    Errors5 out{};
    for (std::size_t e = 0; e < out.size(); ++e) out[e] = (above[e] - below[e]) / (2 * step);
    return out;
  }
  Errors5 by_reading(const AxisErrors& carriage, double travel_m,
                     const Eigen::VectorXd& gain) const {
    AxisErrors above = carriage, below = carriage;
    for (std::size_t e = 0; e < kErrorCount; ++e) {
      const double step = kReadingStep_m * gain(static_cast<Eigen::Index>(e));
      above.local[e] += step;
      below.local[e] -= step;
    }
    return slope(stated(above, travel_m), stated(below, travel_m), kReadingStep_m);
  }

  // Change of the solved errors by 1 m of travel, for the same readings. Calculated from the gain,
  // because an iterative solution takes much longer.
  Errors5 by_travel(const AxisErrors& carriage, double travel_m,
                    const Eigen::MatrixXd& gain) const {
    const double ahead_m = travel_m + kTravelStep_m, behind_m = travel_m - kTravelStep_m;
    const Eigen::VectorXd change =
        gain * (rigid_readings(solver_.fixture(), ahead_m, carriage.local) -
                rigid_readings(solver_.fixture(), behind_m, carriage.local));
    AxisErrors ahead = carriage, behind = carriage;
    for (std::size_t e = 0; e < kErrorCount; ++e) {
      ahead.local[e] -= change(static_cast<Eigen::Index>(e)) / 2;
      behind.local[e] += change(static_cast<Eigen::Index>(e)) / 2;
    }
    return slope(stated(ahead, ahead_m), stated(behind, behind_m), kTravelStep_m);
  }
  // For the other models. Their gain has an error of up to 1e-3, and their solution is fast.
  // Therefore the errors are solved at both travels.
  Errors5 by_travel(double travel_m) const {
    const auto solved = [&](double at_m) {
      return stated(solver_.solve_without_covariance(at_m, p_.point.probe_m, p_.point.probe_u_m),
                    at_m);
    };
    return slope(solved(travel_m + kTravelStep_m), solved(travel_m - kTravelStep_m), kTravelStep_m);
  }

  const Solver& solver_;
  const Run& run_;
  const MeasuredPoint& p_;
};

}  // namespace

std::vector<PointSensitivity> point_sensitivities(const Solver& solver, const Run& run) {
  std::vector<PointSensitivity> all;
  all.reserve(run.points.size());
  const std::vector<LocalSlope> slopes = local_slopes(run);
  for (std::size_t j = 0; j < run.points.size(); ++j) {
    PointSensitivity& s = all.emplace_back(Differences(solver, run, run.points[j]).take());
    for (std::size_t e = 0; e < kErrorCount && s.valid; ++e) {
      const double by_place = s.by_travel[e] - slopes[j].slope[e];
      s.by_place[e] = std::copysign(std::hypot(by_place, slopes[j].unseen[e]), by_place);
    }
  }
  return all;
}

}  // namespace mdof::algo
