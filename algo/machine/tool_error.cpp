#include "algo/machine/tool_error.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "schema/sample.h"

namespace mdof::algo {
namespace {

double size_of(const std::array<double, kBodyErrors>& errors, std::size_t from) {
  return std::abs(errors[from]) + std::abs(errors[from + 1]) + std::abs(errors[from + 2]);
}

// Product of the poses of the frames from the bed to the work (of_work), or from the bed to the
// tool. pose(i): pose of frame i.
template <class PoseOf>
Pose bodies(const Machine& machine, bool of_work, PoseOf pose) {
  Pose all;
  for (std::size_t i = 0; i < machine.frames.size(); ++i) {
    if (machine.frames[i].carries_work != of_work) continue;
    all = of_work ? pose(i) * all : all * pose(i);
  }
  return all;
}

template <class PoseOf>
Pose tool_in_work(const Machine& machine, PoseOf pose) {
  const Pose work = bodies(machine, true, pose), tool = bodies(machine, false, pose);
  return work.inverse() * tool * Pose{Eigen::Matrix3d::Identity(), vector_of(machine.tool_m)};
}

Eigen::Vector3d unit(std::size_t k) {
  return Eigen::Vector3d::Unit(static_cast<Eigen::Index>(k % 3));
}

// Displacement and rotation of a point by one unit of an error of a body, without the motions of
// the bodies nearer to the bed. In the functions below, `at` is the place of the point after the
// motion of the body.
struct Effect {
  Eigen::Vector3d shift = Eigen::Vector3d::Zero(), turn = Eigen::Vector3d::Zero();
};

Effect effect_of_body(const MachineFrame& frame, std::size_t k, const Eigen::Vector3d& at,
                      double travel) {
  if (k < 3) return {unit(k), Eigen::Vector3d::Zero()};
  return {unit(k).cross(at - holding_point(frame, travel)), unit(k)};
}

Effect effect_of_location(const MachineFrame& frame, std::size_t k, const Eigen::Vector3d& at,
                          double travel) {
  if (frame.kind == FrameKind::linear)
    return {unit(k).cross(unit(frame.direction)) * travel, Eigen::Vector3d::Zero()};
  const Eigen::Matrix3d turn = turn_about(frame.direction, travel);
  if (k < 3) return {unit(k) - turn * unit(k), Eigen::Vector3d::Zero()};
  const Eigen::Vector3d arm = at - vector_of(frame.at_m);
  // T: turn about the axis; R0: small rotation θ of the axis line. R0 T R0ᵀ = (1 + [θ - Tθ]×) T
  const Eigen::Vector3d about = unit(k) - turn * unit(k);
  return {about.cross(arm), about};
}

// Places and rotations of the nominal machine at a command.
struct Walk {
  std::vector<Eigen::Vector3d> at;  // at[i]: place of the tool's point after the motion of frame i
  std::vector<Eigen::Matrix3d> outer;  // outer[i]: rotation by the frames between frame i and the
                                       // bed
  Eigen::Matrix3d to_work;  // rotation from the coordinates of the bed to those of the work
};

Walk walk(const Machine& machine, const Command& command) {
  const std::size_t n = machine.frames.size();
  Walk w{std::vector<Eigen::Vector3d>(n), std::vector<Eigen::Matrix3d>(n), {}};
  const auto pose = [&](std::size_t i) {
    return nominal_pose(machine.frames[i], travel_of(machine.frames[i], command));
  };
  Pose tool, work;
  for (std::size_t i = 0; i < n; ++i) {  // from the bed to the tool
    if (machine.frames[i].carries_work) continue;
    w.outer[i] = tool.R;
    tool = tool * pose(i);
  }
  for (std::size_t i = n; i-- > 0;) {  // from the bed to the work
    if (!machine.frames[i].carries_work) continue;
    w.outer[i] = work.R;
    work = work * pose(i);
  }
  Eigen::Vector3d point = vector_of(machine.tool_m);
  for (std::size_t i = n; i-- > 0;)
    if (!machine.frames[i].carries_work) w.at[i] = point = pose(i) * point;
  point = work.inverse() * point;  // the point of the work that is at the tool's point
  for (std::size_t i = 0; i < n; ++i)
    if (machine.frames[i].carries_work) w.at[i] = point = pose(i) * point;
  w.to_work = work.R.transpose();
  return w;
}

bool is_known(const MachineFrame& frame, const ErrorDerivative& d) {
  return d.of_line ? frame.location[d.k].value.has_value() : frame.error[d.k].known();
}

bool has_u(const MachineFrame& frame, const ErrorDerivative& d) {
  return d.of_line ? frame.location[d.k].u.has_value() : !frame.error[d.k].u.empty();
}

// Two location errors describe one squareness. True: `d` is not reported as missing, because the
// other error is known or is reported instead.
bool is_implied_by_other_squareness(const Machine& machine, const ErrorDerivative& d) {
  const MachineFrame& frame = machine.frames[d.frame];
  if (!d.of_line || frame.kind != FrameKind::linear || is_known(frame, d)) return false;
  const MachineFrame* axis = squareness_partner(machine, d);
  if (!axis) return true;  // the squareness does not exist
  return axis->location[d.k].value.has_value() || frame.direction < axis->direction;
}

std::string name_of(const Machine& machine, const ErrorDerivative& d) {
  const MachineFrame& frame = machine.frames[d.frame];
  return d.of_line ? location_name(frame, d.k) : error_name(frame, d.k);
}

// True: the error should have been measured. Errors of fixed frames are optional.
bool counts_as_missing(const Machine& machine, const ErrorDerivative& d) {
  const MachineFrame& frame = machine.frames[d.frame];
  return frame.kind != FrameKind::fixed && !is_known(frame, d) &&
         !is_implied_by_other_squareness(machine, d);
}

void name_missing_errors(const Machine& machine, const std::vector<ErrorDerivative>& all,
                         ToolError& error) {
  for (const ErrorDerivative& d : all) {
    const bool known = is_known(machine.frames[d.frame], d);
    const bool missing = counts_as_missing(machine, d);
    if (known ? has_u(machine.frames[d.frame], d) : !missing) continue;
    for (std::size_t c = 0; c < 6; ++c) {
      if (std::abs(d.d[static_cast<Eigen::Index>(c)]) < 1e-12) continue;
      (known ? error.no_u : error.not_measured)[c].push_back(name_of(machine, d));
    }
  }
}

}  // namespace

void add_new(const std::vector<std::string>& names, std::vector<std::string>& to) {
  for (const std::string& name : names)
    if (std::find(to.begin(), to.end(), name) == to.end()) to.push_back(name);
}

const MachineFrame* squareness_partner(const Machine& machine, const ErrorDerivative& d) {
  const MachineFrame& frame = machine.frames[d.frame];
  if (!d.of_line || frame.kind != FrameKind::linear) return nullptr;
  const std::size_t other = 3 - frame.direction - d.k % 3;  // rotation k is about the third axis
  return machine.find(std::string(1, "XYZ"[other]));
}

bool is_measured(const Machine& machine, const ErrorDerivative& d) {
  const MachineFrame* axis = squareness_partner(machine, d);
  return is_known(machine.frames[d.frame], d) || (axis && axis->location[d.k].value.has_value());
}

Pose nominal_tool(const Machine& machine, const Command& command) {
  return tool_in_work(machine, [&](std::size_t i) {
    return nominal_pose(machine.frames[i], travel_of(machine.frames[i], command));
  });
}

Pose actual_tool(const Machine& machine, const std::vector<FrameValues>& values) {
  return tool_in_work(machine,
                      [&](std::size_t i) { return actual_pose(machine.frames[i], values[i]); });
}

Vector6 exact_error(const Machine& machine, const Command& command,
                    const std::vector<FrameValues>& values) {
  const Pose nominal = nominal_tool(machine, command), actual = actual_tool(machine, values);
  Vector6 error;
  error << actual.p - nominal.p, small_angles_of(actual.R * nominal.R.transpose());
  return error;
}

std::vector<ErrorDerivative> derivatives(const Machine& machine, const Command& command) {
  const Walk w = walk(machine, command);
  std::vector<ErrorDerivative> all;
  for (std::size_t i = 0; i < machine.frames.size(); ++i) {
    const MachineFrame& frame = machine.frames[i];
    const double travel = travel_of(frame, command);
    const Eigen::Matrix3d out = w.to_work * w.outer[i] * (frame.carries_work ? -1 : 1);
    const auto add = [&](std::size_t k, bool of_line, const Effect& effect) {
      ErrorDerivative d{i, k, of_line, {}};
      d.d << out * effect.shift, out * effect.turn;
      all.push_back(d);
    };
    for (std::size_t k = 0; k < kBodyErrors; ++k)
      add(k, false, effect_of_body(frame, k, w.at[i], travel));
    for (std::size_t k = 0; k < kBodyErrors; ++k)
      if (has_location(frame, k)) add(k, true, effect_of_location(frame, k, w.at[i], travel));
  }
  return all;
}

Vector6 linear_error(const std::vector<ErrorDerivative>& derivatives,
                     const std::vector<FrameValues>& values) {
  Vector6 sum = Vector6::Zero();
  for (const ErrorDerivative& d : derivatives) {
    const FrameValues& v = values[d.frame];
    sum += d.d * (d.of_line ? v.location[d.k] : v.error[d.k]);
  }
  return sum;
}

namespace {

// Variance due to the errors of the bodies: the sum of the squared effects of all independent parts
// of all frames.
Vector6 body_variance(const std::vector<ErrorDerivative>& derivatives,
                      const std::vector<FrameValues>& values) {
  std::vector<Eigen::Matrix<double, 6, kBodyErrors>> parts(
      values.size(), Eigen::Matrix<double, 6, kBodyErrors>::Zero());
  for (const ErrorDerivative& d : derivatives)
    if (!d.of_line)
      parts[d.frame] += d.d * values[d.frame].u_parts.row(static_cast<Eigen::Index>(d.k));
  Vector6 sum = Vector6::Zero();
  for (const auto& of_frame : parts) sum += of_frame.cwiseAbs2().rowwise().sum();
  return sum;
}

}  // namespace

std::vector<Vector6> shared_effects(const std::vector<ErrorDerivative>& derivatives,
                                    const std::vector<FrameValues>& values) {
  std::vector<Vector6> effects;
  for (const ErrorDerivative& d : derivatives) {
    const auto& shared = values[d.frame].shared;
    if (d.of_line) continue;
    if (effects.size() < shared.size()) effects.resize(shared.size(), Vector6::Zero());
    for (std::size_t p = 0; p < shared.size(); ++p) effects[p] += d.d * shared[p][d.k];
  }
  return effects;
}

Vector6 error_uncertainty(const std::vector<ErrorDerivative>& derivatives,
                          const std::vector<FrameValues>& values) {
  Vector6 sum = body_variance(derivatives, values);
  for (const ErrorDerivative& d : derivatives)
    if (d.of_line) sum += (d.d * values[d.frame].u_location[d.k]).cwiseAbs2();
  for (const Vector6& part : shared_effects(derivatives, values)) sum += part.cwiseAbs2();
  return sum.cwiseSqrt();
}

LinearBound linear_bound(const Machine& machine, const Command& command,
                         const std::vector<FrameValues>& values) {
  const Walk w = walk(machine, command);
  double shifts = 0, turns = 0, arm = 0;
  for (std::size_t i = 0; i < machine.frames.size(); ++i) {
    const MachineFrame& frame = machine.frames[i];
    const FrameValues& v = values[i];
    // Location errors of a rotary axis count twice. The body is displaced to the actual axis line,
    // turned, and displaced back.
    const double twice = frame.kind == FrameKind::rotary ? 2 : 1;
    shifts += size_of(v.error, 0) + twice * size_of(v.location, 0);
    turns += size_of(v.error, 3) + twice * size_of(v.location, 3);
    arm = std::max(arm, (w.at[i] - holding_point(frame, v.travel)).norm());
    if (moves_along(frame)) arm = std::max(arm, std::abs(v.travel));
  }
  const double more = 1 + 4 * turns;  // factor for the terms of higher order
  return {(2 * turns * shifts + 3 * turns * turns * arm) * more, turns * turns * more};
}

ToolError tool_error(const Machine& machine, const Command& command, MachineApproach approach) {
  const auto values = values_at(machine, command, approach);
  const auto all = derivatives(machine, command);
  ToolError error{exact_error(machine, command, values),
                  linear_error(all, values),
                  error_uncertainty(all, values),
                  linear_bound(machine, command, values),
                  {},
                  {},
                  {}};
  name_missing_errors(machine, all, error);
  // u is 0, not NaN, if all contributing errors are declared with u = 0.
  for (std::size_t c = 0; c < 6; ++c)
    if (double& u = error.u[static_cast<Eigen::Index>(c)];
        u == 0 && !(error.no_u[c].empty() && error.not_measured[c].empty()))
      u = kNaN;
  for (std::size_t i = 0; i < values.size(); ++i)
    for (std::size_t k = 0; k < kBodyErrors; ++k)
      if (values[i].beyond[k]) error.beyond.push_back(error_name(machine.frames[i], k));
  return error;
}

}  // namespace mdof::algo
