#include "algo/machine/geometric_tests/circle.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "schema/sample.h"

namespace mdof::algo {
namespace {

constexpr std::size_t kFewestAngles = 8, kMostAngles = 100'000;
constexpr double kLargestGap_rad = std::numbers::pi / 2;
constexpr double kMostRadius_m = 10;
constexpr double kRounding = 1e-9;  // relative to the radius

// Radial deviation of a circle: radius_m + a_m cos(angle) + b_m sin(angle).
struct Circle {
  double radius_m = 0, a_m = 0, b_m = 0;
  double at(double angle_rad) const {
    return radius_m + a_m * std::cos(angle_rad) + b_m * std::sin(angle_rad);
  }
};

// Least-squares circle of one or both paths.
Circle circle_of(const CircularPath& path, bool ccw, bool cw) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const auto* deviations : {ccw ? &path.ccw_m : nullptr, cw ? &path.cw_m : nullptr}) {
    for (std::size_t i = 0; deviations && i < deviations->size(); ++i) {
      const Eigen::Vector3d row(1, std::cos(path.angle_rad[i]), std::sin(path.angle_rad[i]));
      normal += row * row.transpose();
      right += row * (*deviations)[i];
    }
  }
  const Eigen::Vector3d found = normal.ldlt().solve(right);
  return {found[0], found[1], found[2]};
}

struct Extent {
  double low = INFINITY, high = -INFINITY;
  void take(double x) {
    low = std::min(low, x);
    high = std::max(high, x);
  }
  double range() const { return high - low; }
};

// Smallest and largest value of the deviations minus `circle`.
Extent extent_about(const CircularPath& path, const std::vector<double>& deviations,
                    const Circle& circle) {
  Extent extent;
  for (std::size_t i = 0; i < deviations.size(); ++i)
    extent.take(deviations[i] - circle.at(path.angle_rad[i]));
  return extent;
}

double largest_gap(std::vector<double> angles) {
  for (double& a : angles) a -= 2 * std::numbers::pi * std::floor(a / (2 * std::numbers::pi));
  std::sort(angles.begin(), angles.end());
  double gap = angles.front() + 2 * std::numbers::pi - angles.back();
  for (std::size_t i = 1; i < angles.size(); ++i) gap = std::max(gap, angles[i] - angles[i - 1]);
  return gap;
}

Status check_path(const CircularPath& path) {
  const std::size_t n = path.angle_rad.size();
  const auto fits = [n](const std::vector<double>& v) { return v.empty() || v.size() == n; };
  const auto finite = [](const std::vector<double>& v) {
    return std::all_of(v.begin(), v.end(), [](double x) { return std::isfinite(x); });
  };
  if ((path.ccw_m.empty() && path.cw_m.empty()) || !fits(path.ccw_m) || !fits(path.cw_m))
    return bad_input(
        "a circular path needs a deviation for each angle in at least one direction (clockwise or "
        "counterclockwise)");
  if (!finite(path.angle_rad) || !finite(path.ccw_m) || !finite(path.cw_m))
    return bad_input("every angle and deviation of a circular path must be a finite number");
  if (n < kFewestAngles || largest_gap(path.angle_rad) > kLargestGap_rad + 1e-9)
    return bad_input(
        "a circular path needs at least 8 angles, with at most 90 degrees between neighbouring "
        "angles, because an arc does not determine the centre");
  return {};
}

// Values of the frames at this angle. The approach of each axis is its direction of motion just
// before this angle. `way`: +1 counter-clockwise, -1 clockwise.
std::vector<FrameValues> values_on(const Machine& machine, const CircleRequest& request,
                                   const Command& command, double angle_rad, double way) {
  std::vector<FrameValues> values;
  for (const MachineFrame& frame : machine.frames) {
    auto approach = MachineApproach::mean;
    const bool linear = frame.kind == FrameKind::linear;
    const double before = angle_rad - way * 1e-9;
    const double speed = linear && frame.direction == request.first    ? -way * std::sin(before)
                         : linear && frame.direction == request.second ? way * std::cos(before)
                                                                       : 0;
    if (speed != 0) approach = speed > 0 ? MachineApproach::forward : MachineApproach::reverse;
    values.push_back(values_at(frame, command, approach));
  }
  return values;
}

Status check_request(const Machine& machine, const CircleRequest& request) {
  for (const std::size_t axis : {request.first, request.second}) {
    const std::string name(1, "XYZ"[axis]);
    if (!machine.find(name))
      return bad_input("the chain " + machine.chain.text + " has no axis " + name +
                       "; use only axes of this chain");
  }
  if (!(request.radius_m > 0 && request.radius_m <= kMostRadius_m))
    return bad_input("the radius of a circle must be above 0 and at most 10 m");
  if (request.angles >= kFewestAngles && request.angles <= kMostAngles) return {};
  return bad_input("the number of angles of a circle must be from 8 to 100,000");
}

// The command at an angle of the circle.
Command command_at(const CircleRequest& request, double angle_rad) {
  Command command = request.centre;
  command[request.first] += request.radius_m * std::cos(angle_rad);
  command[request.second] += request.radius_m * std::sin(angle_rad);
  return command;
}

// A rotary axis between the two axes makes an ellipse from the circle of the commands, if its angle
// is not a multiple of 90 degrees. Then two radii at right angles to each other differ.
Status check_is_circle(const Machine& machine, const CircleRequest& request) {
  const Eigen::Vector3d centre = nominal_tool(machine, request.centre).p;
  for (const double angle_rad : {std::numbers::pi / 4, 3 * std::numbers::pi / 4}) {
    const double radius_m =
        (nominal_tool(machine, command_at(request, angle_rad)).p - centre).norm();
    if (std::abs(radius_m - request.radius_m) > kRounding * request.radius_m)
      return bad_input(
          "the commands of a circle in the plane " + std::string(1, "XYZ"[request.first]) +
          "XYZ"[request.second] + " give an ellipse, because a rotary axis of the chain " +
          machine.chain.text +
          " turns one of these axes against the other; set the rotary axes between them to 0 at "
          "the centre of the circle");
  }
  return {};
}

}  // namespace

Result<CircularFigures> circular_figures(const CircularPath& path) {
  MDOF_CHECK(check_path(path));
  const bool ccw = !path.ccw_m.empty(), cw = !path.cw_m.empty();
  const Circle all = circle_of(path, true, true);
  const Circle centre{0, all.a_m, all.b_m};
  CircularFigures f;
  f.centre_m = {all.a_m, all.b_m};
  const Extent about_ccw = extent_about(path, path.ccw_m, all);
  const Extent about_cw = extent_about(path, path.cw_m, all);
  f.G_ccw_m = ccw ? extent_about(path, path.ccw_m, circle_of(path, true, false)).range() : kNaN;
  f.G_cw_m = cw ? extent_about(path, path.cw_m, circle_of(path, false, true)).range() : kNaN;
  f.Gb_m = ccw && cw
               ? std::max(about_ccw.high, about_cw.high) - std::min(about_ccw.low, about_cw.low)
               : kNaN;
  f.D_m = ccw && cw ? all.radius_m : kNaN;
  f.H_m = ccw && cw ? 0 : kNaN;
  for (std::size_t i = 0; ccw && cw && i < path.angle_rad.size(); ++i)
    f.H_m = std::max(f.H_m, std::abs(path.ccw_m[i] - path.cw_m[i]));
  const auto radial = [&](const std::vector<double>& deviations) {
    if (deviations.empty()) return std::array{kNaN, kNaN};
    const Extent extent = extent_about(path, deviations, centre);
    return std::array{extent.high, extent.low};
  };
  f.F_ccw_m = radial(path.ccw_m);
  f.F_cw_m = radial(path.cw_m);
  return f;
}

CircularPath centred(const CircularPath& path, const CircularFigures& figures) {
  const Circle centre{0, figures.centre_m[0], figures.centre_m[1]};
  CircularPath out = path;
  for (auto* deviations : {&out.ccw_m, &out.cw_m})
    for (std::size_t i = 0; i < deviations->size(); ++i)
      (*deviations)[i] -= centre.at(out.angle_rad[i]);
  return out;
}

Result<PredictedCircle> predicted_circle(const Machine& machine, const CircleRequest& request) {
  MDOF_CHECK(check_request(machine, request));
  MDOF_CHECK(check_is_circle(machine, request));
  PredictedCircle predicted;
  CircularPath& path = predicted.path;
  const Eigen::Vector3d ball =
      actual_tool(machine, values_at(machine, request.centre, MachineApproach::mean)).p;
  for (std::size_t i = 0; i < request.angles; ++i) {
    const double angle =
        2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(request.angles);
    const Command command = command_at(request, angle);
    const auto radius = [&](double way) {
      return (actual_tool(machine, values_on(machine, request, command, angle, way)).p - ball)
          .norm();
    };
    path.angle_rad.push_back(angle);
    path.ccw_m.push_back(radius(+1) - request.radius_m);
    path.cw_m.push_back(radius(-1) - request.radius_m);
    const ToolError error = tool_error(machine, command, MachineApproach::mean);
    for (const std::size_t k : {request.first, request.second})
      add_new(error.not_measured[k], predicted.not_measured);
    add_new(error.beyond, predicted.beyond);
  }
  return predicted;
}

}  // namespace mdof::algo
