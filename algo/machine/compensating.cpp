#include "algo/machine/compensating.h"

#include <algorithm>
#include <cmath>

#include "algo/linear_algebra/least_squares.h"

namespace mdof::algo {
namespace {

constexpr int kMostSteps = 50;
constexpr double kConverged_m = 1e-12;
// Linear axes with a smaller angle (rad) between them are treated as parallel. The places of the
// tool are not exact, because they are rounded and the computed cos 90° is 6e-17.
constexpr double kParallel = 1e-9;

using Jacobian = Eigen::Matrix<double, 3, Eigen::Dynamic>;

std::vector<std::size_t> linear_axes(const Machine& machine) {
  std::vector<std::size_t> directions;
  for (const MachineFrame& frame : machine.frames)
    if (frame.kind == FrameKind::linear) directions.push_back(frame.direction);
  return directions;
}

// Derivatives of the tool's place by the commands of the linear axes. The nominal place is linear
// in these commands, so a difference over 1 m has no truncation error.
Jacobian jacobian(const Machine& machine, const Command& at,
                  const std::vector<std::size_t>& directions) {
  Jacobian J(3, static_cast<Eigen::Index>(directions.size()));
  const Eigen::Vector3d here = nominal_tool(machine, at).p;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    Command moved = at;
    moved[directions[i]] += 1;
    J.col(static_cast<Eigen::Index>(i)) = nominal_tool(machine, moved).p - here;
  }
  return J;
}

// Motion of the nominal tool relative to the work by a command of 1 m, with all rotary axes at 0.
// Exact, because it is not calculated as a difference of places.
Eigen::Vector3d motion_by_command(const Machine& machine, std::size_t direction) {
  Command unit{};
  unit[direction] = 1;
  Eigen::Vector3d motion = Eigen::Vector3d::Zero();
  for (const MachineFrame& frame : machine.frames)
    if (moves_along(frame))
      motion(static_cast<Eigen::Index>(frame.direction)) +=
          (frame.carries_work ? -1 : 1) * travel_of(frame, unit);
  return motion;
}

// Letter of the axis whose command the frame uses; 0: no axis.
char axis_of(const MachineFrame& frame) {
  if (frame.moves_with != 0) return frame.moves_with;
  return frame.kind == FrameKind::fixed ? '\0' : frame.id.front();
}

// Letters of the axes that have an error with different values for forward and reverse approach.
std::string axes_by_approach(const Machine& machine) {
  std::string axes;
  for (const MachineFrame& frame : machine.frames) {
    const bool differs = std::any_of(frame.error.begin(), frame.error.end(),
                                     [](const ErrorFunction& f) { return !f.reverse.empty(); });
    if (differs && axes.find(axis_of(frame)) == std::string::npos) axes += axis_of(frame);
  }
  return axes;
}

}  // namespace

Result<CompensatingCommand> compensating_command(const Machine& machine, const Command& wanted,
                                                 MachineApproach approach) {
  const auto directions = linear_axes(machine);
  if (directions.empty())
    return bad_input("the chain " + machine.chain.text +
                     " has no linear axis, so there is no commanded position to correct");
  const LeastNorm inverse(jacobian(machine, wanted, directions), kParallel);
  const Eigen::Vector3d target = nominal_tool(machine, wanted).p;
  CompensatingCommand c;
  c.command = wanted;
  for (c.steps = 0; c.steps < kMostSteps && !c.converged; ++c.steps) {
    const Pose reached = actual_tool(machine, values_at(machine, c.command, approach));
    const Eigen::VectorXd step = inverse.solve(Eigen::VectorXd(target - reached.p));
    for (std::size_t i = 0; i < directions.size(); ++i)
      c.command[directions[i]] += step[static_cast<Eigen::Index>(i)];
    c.converged = step.norm() < kConverged_m;
  }
  const auto values = values_at(machine, c.command, approach);
  c.residual_m = actual_tool(machine, values).p - target;
  c.angles_rad = exact_error(machine, c.command, values).tail<3>();
  for (std::size_t i = 0; i < values.size(); ++i)
    for (std::size_t k = 0; k < kBodyErrors; ++k)
      if (values[i].beyond[k]) c.beyond.push_back(error_name(machine.frames[i], k));
  return c;
}

Command command_at_place(const Machine& machine, const Eigen::Vector3d& place_m) {
  Command command{};
  const auto directions = linear_axes(machine);
  if (directions.empty()) return command;
  Jacobian J(3, static_cast<Eigen::Index>(directions.size()));
  for (std::size_t i = 0; i < directions.size(); ++i)
    J.col(static_cast<Eigen::Index>(i)) = motion_by_command(machine, directions[i]);
  const Eigen::VectorXd commands = LeastNorm(J).solve(Eigen::VectorXd(place_m));
  for (std::size_t i = 0; i < directions.size(); ++i)
    command[directions[i]] = commands[static_cast<Eigen::Index>(i)];
  return command;
}

Eigen::MatrixXd fixed_directions(const Machine& machine, const Command& command) {
  const auto directions = linear_axes(machine);
  if (directions.empty()) return Eigen::Matrix3d::Identity();
  const Eigen::MatrixXd J = jacobian(machine, command, directions);
  return LeastNorm(J.transpose(), kParallel).null_space();
}

std::vector<ErrorDerivative> command_derivatives(const Machine& machine, const Command& command) {
  std::vector<ErrorDerivative> all = derivatives(machine, command);
  const auto directions = linear_axes(machine);
  const LeastNorm inverse(jacobian(machine, command, directions), kParallel);
  for (ErrorDerivative& d : all) {
    const Eigen::VectorXd step = inverse.solve(Eigen::VectorXd(d.d.head<3>()));
    d.d.head<3>().setZero();
    for (std::size_t i = 0; i < directions.size(); ++i)
      d.d[static_cast<Eigen::Index>(directions[i])] = step[static_cast<Eigen::Index>(i)];
  }
  return all;
}

std::array<double, 3> command_reversal(const Machine& machine, const Command& command) {
  std::array<double, 3> sum{};
  const auto directions = linear_axes(machine);
  if (directions.empty()) return sum;
  const LeastNorm inverse(jacobian(machine, command, directions), kParallel);
  const auto mean = values_at(machine, command, MachineApproach::mean);
  for (const char axis : axes_by_approach(machine)) {
    const auto tool = [&](MachineApproach approach) {
      auto values = mean;
      for (std::size_t i = 0; i < values.size(); ++i)
        if (axis_of(machine.frames[i]) == axis)
          values[i] = values_at(machine.frames[i], command, approach);
      return actual_tool(machine, values).p;
    };
    const Eigen::VectorXd step = inverse.solve(
        Eigen::VectorXd(tool(MachineApproach::forward) - tool(MachineApproach::reverse)));
    for (std::size_t i = 0; i < directions.size(); ++i)
      sum[directions[i]] += std::abs(step[static_cast<Eigen::Index>(i)]);
  }
  return sum;
}

}  // namespace mdof::algo
